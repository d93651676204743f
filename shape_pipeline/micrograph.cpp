// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/micrograph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "catalog/input_error.h"
#include "shape_pipeline/ct_stack.h"
#include "shape_pipeline/micrographs/data_strip.h"
#include "shape_pipeline/micrographs/distance_basins.h"
#include "shape_pipeline/micrographs/grain_seams.h"
#include "shape_pipeline/micrographs/image_file.h"
#include "shape_pipeline/micrographs/image_filters.h"
#include "shape_pipeline/micrographs/outline_tracing.h"
#include "shape_pipeline/micrographs/plane_geometry.h"

namespace shape_pipeline {
namespace {

namespace fs = std::filesystem;

constexpr double kSmoothing = 1;    // [pixels]; below it is the noise of the detector
constexpr double kThinnest = 0.45;  // radius of the largest disc inside / of equal area; threads and films are thinner
constexpr double kLeastContrast = 3;    // noises; Otsu parts mere noise at 1.6
constexpr double kDarkestShare = 0.26;  // mean grey of a grain over the usual contrast; films are darker

/// The image without its strip.
GreyImage upper_rows(const GreyImage& image, int rows) {
  GreyImage part(image.width, rows);
  std::copy_n(image.values.begin(), part.values.size(), part.values.begin());
  return part;
}

double pixel_size(const fs::path& path, const GreyImage& image, const MicrographOptions& options, Micrograph& result) {
  if (options.pixel_size > 0) return options.pixel_size;
  if (!(options.scale_bar_length > 0))
    throw catalog::InputError(
        path.string() +
        ": images state no pixel size that could be trusted; add --pixel '0.5 um', or --scale-bar "
        "'100 um' with what its scale bar stands for");
  const std::optional<ScaleBar> bar = find_scale_bar(image, result.strip_top);
  if (!bar)
    throw catalog::InputError(path.string() + ": found no " +
                              (result.strip_top < image.height ? "straight bar in the data strip"
                                                               : "data strip with a scale bar below the image") +
                              "; measure the scale bar and give the pixel's side by --pixel '0.5 um'");
  result.bar_pixels = bar->length();
  const double bottom = bar->top + bar->rows, top = bar->top;
  result.bar = {{bar->left, top}, {bar->right, top}, {bar->right, bottom}, {bar->left, bottom}};
  return options.scale_bar_length / bar->length();
}

struct Region {
  double area = 0, grey = 0;  // [pixels], sum of grey
  bool is_cut = false;
};

std::vector<Region> regions_of(const LabelImage& labels, const GreyImage& grey) {
  std::vector<Region> regions(static_cast<std::size_t>(label_count(labels)) + 1);
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      Region& region = regions[static_cast<std::size_t>(labels(x, y))];
      ++region.area;
      region.grey += grey(x, y);
      region.is_cut |= x == 0 || y == 0 || x + 1 == labels.width || y + 1 == labels.height;
    }
  return regions;
}

std::vector<OutlineDescriptor> described(const Outline& outline, double pixel) {
  Outline metres = outline;
  for (PlanePoint& p : metres) p = {p[0] * pixel, p[1] * pixel};
  return outline_descriptors(metres, pixel);
}

/// Sorts the regions into grains, grains at the border, specks and films.
void collect(const LabelImage& labels, const GreyImage& grey, const GreyLevels& levels,
             const MicrographOptions& options, Micrograph& result) {
  const std::vector<Region> regions = regions_of(labels, grey);
  const std::vector<double> radii = region_radii(labels);
  const std::vector<Outline> outlines = region_outlines(labels, grey, levels);
  const double least_area = std::numbers::pi / 4 * options.least_diameter * options.least_diameter;
  for (std::size_t label = 1; label < regions.size(); ++label) {
    const Region& region = regions[label];
    const bool is_film = radii[label] < kThinnest * std::sqrt(region.area / std::numbers::pi) ||
                         region.grey / region.area - levels.background < kDarkestShare * levels.contrast();
    const double area = outlines[label].empty() ? 0 : std::abs(plane_moments(outlines[label]).area);
    if (area < least_area)
      ++result.specks;
    else if (is_film)
      ++result.films;
    else if (region.is_cut)
      result.at_border.push_back({outlines[label], {}});
    else
      result.grains.push_back({outlines[label], described(outlines[label], result.pixel_size)});
  }
  std::stable_sort(result.grains.begin(), result.grains.end(), [](const auto& a, const auto& b) {
    return descriptor_value(a.descriptors, "area_imagej") > descriptor_value(b.descriptors, "area_imagej");
  });
}

std::vector<ColourLine> overlay_lines(const Micrograph& micrograph) {
  constexpr std::array<int, 3> kWhole{60, 230, 60}, kCut{255, 150, 0}, kStrip{80, 140, 255};
  std::vector<ColourLine> lines;
  for (const MicrographGrain& grain : micrograph.grains) lines.push_back({grain.outline, kWhole, true});
  for (const MicrographGrain& grain : micrograph.at_border) lines.push_back({grain.outline, kCut, true});
  if (!micrograph.bar.empty()) lines.push_back({micrograph.bar, kStrip, true});
  const double top = micrograph.strip_top, width = micrograph.width;
  if (micrograph.strip_top < micrograph.height) lines.push_back({{{0, top}, {width, top}}, kStrip, false});
  return lines;
}

}  // namespace

Micrograph digitize_micrograph(const fs::path& path, const MicrographOptions& options) {
  const GreyImage image = read_image(path);
  Micrograph result;
  result.width = image.width;
  result.height = image.height;
  result.strip_top = data_strip_top(image);
  result.pixel_size = pixel_size(path, image, options, result);
  GreyImage grains = upper_rows(image, result.strip_top);
  if (options.has_dark_grains)
    for (float& value : grains.values) value = 255 - value;
  const GreyImage smooth = blurred(grains, kSmoothing);
  const GreyLevels levels = grey_levels(smooth);
  if (levels.contrast() > kLeastContrast * levels.noise)
    collect(separated_grains(grains, grain_mask(smooth, levels.threshold), levels), smooth, levels, options, result);
  if (result.grains.empty())
    throw catalog::InputError(
        path.string() + ": shows no whole grain (" + std::to_string(result.at_border.size()) + " cut by the border, " +
        std::to_string(result.specks) +
        " specks), expected bright grains on a dark background; for the reverse add --dark-grains");
  return result;
}

void write_overlay(const fs::path& path, const fs::path& image, const Micrograph& micrograph) {
  write_picture(path, read_image(image), overlay_lines(micrograph));
}

ColourImage overlay(const fs::path& image, const Micrograph& micrograph, int largest_side) {
  const GreyImage grey = read_image(image);
  const double largest = std::max(grey.width, grey.height);
  return picture_of(grey, overlay_lines(micrograph), std::min(1.0, largest_side / largest));
}

bool has_image_ending(const fs::path& path) {
  const std::string ending = lower_ending(path);
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".bmp";
}

}  // namespace shape_pipeline
