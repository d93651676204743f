// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/outline_truth.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <tuple>

#include "catalog/input_error.h"
#include "shape_pipeline/micrographs/plane_geometry.h"
#include "shape_pipeline/micrographs/raster.h"

namespace shape_pipeline {
namespace {

constexpr double kLeastOverlap = 0.5;  // intersection over union of a match

/// The pixels of an outline, in the box about it.
struct Patch {
  int left = 0, top = 0;
  Mask mask;
  double area = 0;  // [pixels]
};

/// Pixels whose centres lie inside, within the image.
Patch filled(const Outline& outline, int width, int height) {
  PlanePoint low = outline.front(), high = low;
  for (const PlanePoint& p : outline)
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  Patch patch;
  patch.left = std::clamp(static_cast<int>(std::floor(low[0])), 0, width - 1);
  patch.top = std::clamp(static_cast<int>(std::floor(low[1])), 0, height - 1);
  patch.mask = Mask(std::clamp(static_cast<int>(std::ceil(high[0])), patch.left + 1, width) - patch.left,
                    std::clamp(static_cast<int>(std::ceil(high[1])), patch.top + 1, height) - patch.top);
  for (int row = 0; row < patch.mask.height; ++row) {
    const double y = patch.top + row + 0.5;
    std::vector<double> crossings;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const PlanePoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
      if ((a[1] > y) != (b[1] > y)) crossings.push_back(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      for (int x = std::max(0, static_cast<int>(std::ceil(crossings[k] - patch.left - 0.5)));
           x < patch.mask.width && patch.left + x + 0.5 < crossings[k + 1]; ++x) {
        patch.mask(x, row) = 255;
        ++patch.area;
      }
  }
  return patch;
}

double intersection_over_union(const Patch& a, const Patch& b) {
  const int left = std::max(a.left, b.left), right = std::min(a.left + a.mask.width, b.left + b.mask.width);
  const int top = std::max(a.top, b.top), bottom = std::min(a.top + a.mask.height, b.top + b.mask.height);
  double both = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) both += a.mask(x - a.left, y - a.top) && b.mask(x - b.left, y - b.top);
  return both > 0 ? both / (a.area + b.area - both) : 0;
}

std::size_t match_count(const std::vector<Patch>& found, const std::vector<Patch>& real) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t f = 0; f < found.size(); ++f)
    for (std::size_t r = 0; r < real.size(); ++r)
      if (const double overlap = intersection_over_union(found[f], real[r]); overlap >= kLeastOverlap)
        pairs.emplace_back(overlap, f, r);
  std::sort(pairs.begin(), pairs.end(), std::greater<>());
  std::vector<bool> is_found(found.size()), is_real(real.size());
  std::size_t matches = 0;
  for (const auto& [overlap, f, r] : pairs) {
    if (is_found[f] || is_real[r]) continue;
    is_found[f] = is_real[r] = true;
    ++matches;
  }
  return matches;
}

/// Whether an outline keeps a pixel away from the image's border.
bool is_whole(const Outline& outline, const Micrograph& image) {
  return std::all_of(outline.begin(), outline.end(), [&](const PlanePoint& p) {
    return p[0] > 1 && p[1] > 1 && p[0] < image.width - 2 && p[1] < image.strip_top - 2;
  });
}

double diameter(const Outline& outline) {
  return std::sqrt(4 * std::abs(plane_moments(outline).area) / std::numbers::pi);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Outline hand_outline(const nlohmann::json& region) {
  const nlohmann::json& shape = region.at("shape_attributes");
  const auto xs = shape.at("all_points_x").get<std::vector<double>>();
  const auto ys = shape.at("all_points_y").get<std::vector<double>>();
  if (xs.size() != ys.size() || xs.size() < 3)
    throw catalog::InputError("an outline has fewer than three corners, or x and y of different number");
  Outline outline;
  for (std::size_t k = 0; k < xs.size(); ++k) outline.push_back({xs[k], ys[k]});
  return outline;
}

}  // namespace

std::vector<Outline> read_hand_outlines(const std::filesystem::path& path, const std::string& image) {
  const auto refuse = [&](const std::string& reason) -> catalog::InputError {
    return catalog::InputError(path.string() + ": " + reason +
                               "; expected a project of the VGG Image Annotator, version 2, with polygons");
  };
  std::ifstream file(path);
  if (!file) throw refuse("cannot be read");
  std::vector<Outline> outlines;
  try {
    const nlohmann::json project = nlohmann::json::parse(file);
    for (const auto& [key, entry] : project.items())
      if (entry.at("filename") == image)
        for (const nlohmann::json& region : entry.at("regions")) outlines.push_back(hand_outline(region));
  } catch (const nlohmann::json::exception& error) {
    throw refuse(error.what());
  } catch (const catalog::InputError& error) {
    throw refuse(error.what());
  }
  if (outlines.empty()) throw refuse("has no outlines of an image '" + image + "'");
  return outlines;
}

OutlineScore score_outlines(const Micrograph& micrograph, const std::vector<Outline>& truth) {
  std::vector<Patch> found, real;
  std::vector<double> found_diameters, real_diameters;
  for (const std::vector<MicrographGrain>* grains : {&micrograph.grains, &micrograph.at_border})
    for (const MicrographGrain& grain : *grains)
      found.push_back(filled(grain.outline, micrograph.width, micrograph.strip_top));
  for (const MicrographGrain& grain : micrograph.grains) found_diameters.push_back(diameter(grain.outline));
  for (const Outline& outline : truth) {
    real.push_back(filled(outline, micrograph.width, micrograph.strip_top));
    if (is_whole(outline, micrograph)) real_diameters.push_back(diameter(outline));
  }
  OutlineScore score{found.size(), real.size(), match_count(found, real)};
  const auto share = [&](std::size_t of) {
    return of ? static_cast<double>(score.matched) / static_cast<double>(of) : 0;
  };
  score.precision = share(score.found);
  score.recall = share(score.real);
  score.f1 =
      2 * static_cast<double>(score.matched) / static_cast<double>(std::max<std::size_t>(1, score.found + score.real));
  score.median_found = median(std::move(found_diameters));
  score.median_real = median(std::move(real_diameters));
  return score;
}

}  // namespace shape_pipeline
