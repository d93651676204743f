// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/silhouettes/silhouette_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "shape_pipeline/micrographs/image_filters.h"
#include "shape_pipeline/micrographs/outline_tracing.h"
#include "shape_pipeline/micrographs/plane_geometry.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/volumes/grey_filters.h"

namespace shape_pipeline {
namespace {

constexpr int kPit = 9;                     // [pixels]
constexpr double kLeastSeparability = 0.7;  // [-]; Otsu parts one Gaussian hump at 0.64
constexpr double kLeastContrast = 10;       // [grey values of 255]
constexpr double kSmoothing = 1;            // [pixels]: a hull shrinks by the noise of every outline
constexpr double kBand = 2.5;               // [pixels] about the outline, where distances are exact

GreyClasses classes_of(const GreyImage& image) {
  GreyVolume volume;
  volume.grid.size = {image.width, image.height, 1};
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.values.size());
  for (const float value : image.values) bytes.push_back(static_cast<std::uint8_t>(std::lround(value)));
  volume.values = std::move(bytes);
  return otsu_classes(volume);
}

double border_grey(const GreyImage& image) {
  std::vector<float> border;
  for (int x = 0; x < image.width; ++x) border.insert(border.end(), {image(x, 0), image(x, image.height - 1)});
  for (int y = 0; y < image.height; ++y) border.insert(border.end(), {image(0, y), image(image.width - 1, y)});
  const auto middle = border.begin() + static_cast<std::ptrdiff_t>(border.size() / 2);
  std::nth_element(border.begin(), middle, border.end());
  return *middle;
}

bool touches_border(const Mask& mask) {
  for (int x = 0; x < mask.width; ++x)
    if (mask(x, 0) || mask(x, mask.height - 1)) return true;
  for (int y = 0; y < mask.height; ++y)
    if (mask(0, y) || mask(mask.width - 1, y)) return true;
  return false;
}

/// Positive where an image's grey is on the grain's side of the threshold; elsewhere than in the mask negative.
Raster<float> grain_field(const GreyImage& image, const std::string& name) {
  const GreyClasses classes = classes_of(image);
  if (classes.separability < kLeastSeparability || classes.bright - classes.dark < kLeastContrast)
    refuse_file(name, "", "no silhouette stands out from the background", "light the grain from behind");
  const double sign = border_grey(image) > classes.threshold ? -1 : 1;
  Raster<float> field(image.width, image.height);
  Mask mask(image.width, image.height);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    field.values[i] = static_cast<float>(sign * (image.values[i] - classes.threshold));
    mask.values[i] = field.values[i] > 0 ? 255 : 0;
  }
  mask = largest_region(mask);
  fill_pits(mask, kPit);
  if (touches_border(mask))
    refuse_file(name, "", "the silhouette touches the border of the image", "take an image that shows it whole");
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const float depth = std::max(std::abs(field.values[i]), 1e-3f);
    field.values[i] = mask.values[i] ? depth : -depth;
  }
  return field;
}

double segment_distance(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
}

/// Distances without a sign: exact near the outlines, elsewhere those to the nearest pixel on the other side.
DistanceImage outline_distance(const Raster<float>& field, const std::vector<Outline>& outlines) {
  Mask inside(field.width, field.height), outside(field.width, field.height);
  for (std::size_t i = 0; i < field.values.size(); ++i) (field.values[i] > 0 ? inside : outside).values[i] = 255;
  const DistanceImage depth = distance_to_outside(inside), height = distance_to_outside(outside);
  DistanceImage result(field.width, field.height);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = std::max(depth.values[i], height.values[i]) - 0.5f;
  DistanceImage near(field.width, field.height, static_cast<float>(kBand));
  for (const Outline& line : outlines)
    for (std::size_t i = 0; i < line.size(); ++i) {
      const PlanePoint &a = line[i], &b = line[(i + 1) % line.size()];
      const auto first = [](double u, double v) { return static_cast<int>(std::floor(std::min(u, v) - kBand)); };
      const auto last = [](double u, double v) { return static_cast<int>(std::ceil(std::max(u, v) + kBand)); };
      for (int y = std::max(0, first(a[1], b[1])); y <= std::min(field.height - 1, last(a[1], b[1])); ++y)
        for (int x = std::max(0, first(a[0], b[0])); x <= std::min(field.width - 1, last(a[0], b[0])); ++x)
          near(x, y) = std::min(near(x, y), static_cast<float>(segment_distance({x + 0.5, y + 0.5}, a, b)));
    }
  for (std::size_t i = 0; i < result.values.size(); ++i)
    if (near.values[i] < static_cast<float>(kBand)) result.values[i] = near.values[i];
  return result;
}

}  // namespace

double SilhouetteImage::at(double column, double row) const {
  const double u = std::clamp(column - 0.5, 0.0, distance.width - 1.001);
  const double v = std::clamp(row - 0.5, 0.0, distance.height - 1.001);
  const int x = static_cast<int>(u), y = static_cast<int>(v);
  const double s = u - x, t = v - y;
  const double value = (1 - t) * ((1 - s) * distance(x, y) + s * distance(x + 1, y)) +
                       t * ((1 - s) * distance(x, y + 1) + s * distance(x + 1, y + 1));
  const double beyond = std::abs(column - 0.5 - u) + std::abs(row - 0.5 - v);  // the border is outside
  return value - beyond;
}

SilhouetteImage silhouette_of(const GreyImage& image, const std::string& name) {
  const Raster<float> field = grain_field(blurred(image, kSmoothing), name);
  const std::vector<Outline> outlines = level_lines(field);
  SilhouetteImage result;
  result.left = image.width;
  result.top = image.height;
  double signed_area = 0;  // holes turn the other way
  for (const Outline& line : outlines) {
    signed_area += plane_moments(line).area;
    for (const PlanePoint& p : line) {
      result.left = std::min(result.left, p[0]);
      result.right = std::max(result.right, p[0]);
      result.top = std::min(result.top, p[1]);
      result.bottom = std::max(result.bottom, p[1]);
    }
  }
  result.area = std::abs(signed_area);
  result.distance = outline_distance(field, outlines);
  for (std::size_t i = 0; i < field.values.size(); ++i)
    if (field.values[i] < 0) result.distance.values[i] = -result.distance.values[i];
  return result;
}

}  // namespace shape_pipeline
