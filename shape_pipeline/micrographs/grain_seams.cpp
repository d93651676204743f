// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/micrographs/grain_seams.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

#include "shape_pipeline/micrographs/distance_basins.h"
#include "shape_pipeline/micrographs/image_filters.h"
#include "shape_pipeline/micrographs/label_sets.h"
#include "shape_pipeline/micrographs/plane_geometry.h"

namespace shape_pipeline {
namespace {

// Fitted to the hand outlines of one micrograph; docs/digitising.md has the figures of two.
constexpr double kWideNeck = 0.70;
constexpr double kEdgeContrast = 0.24;
constexpr double kLikeSizes = 0.70;
constexpr double kNoDent = 0.96;
constexpr double kLeastShaded = 8;  // [pixels] wide; smaller shades lie on the grain itself

constexpr double kCoreShare = 0.5;      // of a region's largest disc: what is deeper is its core
constexpr double kGradientScale = 1.5;  // [pixels]; below it is the grain of the surface
constexpr double kRim = 2;              // [pixels] that the image's blur darkens
constexpr int kSideReach = 4;           // [pixels] on either side of a seam

/// Distance to the outside or to another region, of every pixel.
DistanceImage distance_inside(const LabelImage& regions) {
  Mask inside(regions.width, regions.height);
  for (int y = 0; y < regions.height; ++y)
    for (int x = 0; x < regions.width; ++x) {
      const int label = regions(x, y);
      const auto is_other = [&](int xx, int yy) {
        return regions.has(xx, yy) && regions(xx, yy) && regions(xx, yy) != label;
      };
      inside(x, y) = label && !is_other(x + 1, y) && !is_other(x, y + 1) ? 255 : 0;
    }
  return distance_to_outside(inside);
}

std::vector<double> deepest(const LabelImage& regions, const DistanceImage& distance) {
  std::vector<double> radii(static_cast<std::size_t>(label_count(regions)) + 1, 0.0);
  for (std::size_t i = 0; i < regions.values.size(); ++i) {
    double& radius = radii[static_cast<std::size_t>(regions.values[i])];
    radius = std::max(radius, static_cast<double>(distance.values[i]));
  }
  return radii;
}

using Pixels = std::vector<std::size_t>;

/// Of each pair of touching labels, the pixels on either side of the seam; one that has two sides there comes twice.
std::map<std::pair<int, int>, Pixels> seam_pixels(const LabelImage& regions) {
  std::map<std::pair<int, int>, Pixels> seams;
  for (int y = 0; y < regions.height; ++y)
    for (int x = 0; x < regions.width; ++x)
      for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}}) {
        if (!regions.has(x + dx, y + dy)) continue;
        const int a = regions(x, y), b = regions(x + dx, y + dy);
        if (!a || !b || a == b) continue;
        Pixels& pixels = seams[std::minmax(a, b)];
        pixels.push_back(regions.index(x, y));
        pixels.push_back(regions.index(x + dx, y + dy));
      }
  return seams;
}

/// Mean grey above the background on the side of `label`, near a seam.
double side_grey(const LabelImage& regions, const GreyImage& grey, const Pixels& seam, int label) {
  double sum = 0, count = 0;
  for (const std::size_t i : seam)
    for (int dy = -kSideReach; dy <= kSideReach; ++dy)
      for (int dx = -kSideReach; dx <= kSideReach; ++dx) {
        const int x = regions.x_of(i) + dx, y = regions.y_of(i) + dy;
        if (dx * dx + dy * dy > kSideReach * kSideReach || !regions.has(x, y) || regions(x, y) != label) continue;
        sum += grey(x, y);
        ++count;
      }
  return sum / count;
}

struct RegionShape {
  double area = 0;
  Outline rim;  // corners of pixels that touch another label or the background
};

std::vector<RegionShape> region_shapes(const LabelImage& regions) {
  std::vector<RegionShape> shapes(static_cast<std::size_t>(label_count(regions)) + 1);
  for (int y = 0; y < regions.height; ++y)
    for (int x = 0; x < regions.width; ++x) {
      const int label = regions(x, y);
      if (!label) continue;
      RegionShape& shape = shapes[static_cast<std::size_t>(label)];
      ++shape.area;
      const auto is_same = [&](int xx, int yy) { return regions.has(xx, yy) && regions(xx, yy) == label; };
      if (is_same(x - 1, y) && is_same(x + 1, y) && is_same(x, y - 1) && is_same(x, y + 1)) continue;
      for (const int dx : {0, 1})
        for (const int dy : {0, 1}) shape.rim.push_back({static_cast<double>(x + dx), static_cast<double>(y + dy)});
    }
  for (RegionShape& shape : shapes)
    if (!shape.rim.empty()) shape.rim = plane_hull(shape.rim);
  return shapes;
}

/// Pixels below half the grey of their region, above the background.
Mask shaded_pixels(const LabelImage& regions, const GreyImage& grey, double background) {
  const std::vector<double> greys = region_greys(regions, grey);
  Mask shaded(regions.width, regions.height);
  for (std::size_t i = 0; i < regions.values.size(); ++i)
    if (const int label = regions.values[i]; label)
      shaded.values[i] =
          grey.values[i] - background < 0.5 * (greys[static_cast<std::size_t>(label)] - background) ? 255 : 0;
  return shaded;
}

}  // namespace

std::vector<double> region_greys(const LabelImage& regions, const GreyImage& grey) {
  const DistanceImage distance = distance_inside(regions);
  const std::size_t count = static_cast<std::size_t>(label_count(regions)) + 1;
  std::vector<std::vector<float>> core(count), all(count);
  for (std::size_t i = 0; i < regions.values.size(); ++i) {
    const auto label = static_cast<std::size_t>(regions.values[i]);
    if (label == 0) continue;
    all[label].push_back(grey.values[i]);
    if (distance.values[i] > kRim) core[label].push_back(grey.values[i]);
  }
  std::vector<double> greys(count, 0.0);
  for (std::size_t label = 1; label < count; ++label) {
    std::vector<float>& values = core[label].empty() ? all[label] : core[label];
    if (values.empty()) continue;
    const auto quartile = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
    std::nth_element(values.begin(), quartile, values.end());
    greys[label] = *quartile;
  }
  return greys;
}

std::vector<double> region_radii(const LabelImage& regions) { return deepest(regions, distance_inside(regions)); }

LabelImage with_seams_on_edges(const LabelImage& regions, const Mask& mask, const GreyImage& gradient) {
  const DistanceImage distance = distance_inside(regions);
  const std::vector<double> radii = deepest(regions, distance);
  LabelImage labels(regions.width, regions.height);
  using Front = std::tuple<float, std::size_t, std::size_t>;  // gradient, order of coming, pixel
  std::priority_queue<Front, std::vector<Front>, std::greater<>> front;
  std::size_t come = 0;
  for (std::size_t i = 0; i < regions.values.size(); ++i) {
    const double radius = radii[static_cast<std::size_t>(regions.values[i])];
    if (!regions.values[i] || radius == 0 || distance.values[i] < kCoreShare * radius) continue;
    labels.values[i] = regions.values[i];
    front.emplace(gradient.values[i], come++, i);
  }
  while (!front.empty()) {
    const auto [level, order, i] = front.top();
    front.pop();
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int x = labels.x_of(i) + dx, y = labels.y_of(i) + dy;
      if (!labels.has(x, y) || !mask(x, y) || labels(x, y)) continue;
      labels(x, y) = labels.values[i];
      front.emplace(std::max(level, gradient(x, y)), come++, labels.index(x, y));
    }
  }
  return labels;
}

std::vector<Seam> measured_seams(const LabelImage& regions, const GreyImage& grey, double background) {
  const std::vector<RegionShape> shapes = region_shapes(regions);
  const std::vector<double> radii = region_radii(regions);
  std::vector<Seam> seams;
  for (const auto& [labels, pixels] : seam_pixels(regions)) {
    const auto a = static_cast<std::size_t>(labels.first), b = static_cast<std::size_t>(labels.second);
    Seam seam{labels.first, labels.second};
    // Pairs of pixels along a line of any direction are 4 / pi of its length, on the mean.
    const double length = static_cast<double>(pixels.size() / 2) * std::numbers::pi / 4;
    seam.neck = length / 2 / std::max(0.5, std::min(radii[a], radii[b]));
    const double one = side_grey(regions, grey, pixels, seam.first) - background,
                 other = side_grey(regions, grey, pixels, seam.second) - background;
    seam.contrast = std::abs(one - other) / std::max(1.0, one + other);
    seam.size_ratio = std::sqrt(std::min(shapes[a].area, shapes[b].area) / std::max(shapes[a].area, shapes[b].area));
    Outline both = shapes[a].rim;
    both.insert(both.end(), shapes[b].rim.begin(), shapes[b].rim.end());
    seam.solidity = (shapes[a].area + shapes[b].area) / plane_moments(plane_hull(both)).area;
    seams.push_back(seam);
  }
  return seams;
}

bool is_one_grain(const Seam& seam) {
  if (seam.contrast > kEdgeContrast || seam.neck < kWideNeck) return false;
  return seam.size_ratio < kLikeSizes || seam.solidity > kNoDent;
}

LabelImage separated_grains(const GreyImage& grey, const Mask& mask, const GreyLevels& levels) {
  const GreyImage gradient = gradient_length(blurred(grey, kGradientScale)), smooth = blurred(grey, 1);
  LabelImage labels = distance_basins(mask);
  part_patches(labels, shaded_pixels(labels, smooth, levels.background), kLeastShaded);
  labels = with_seams_on_edges(labels, mask, gradient);
  LabelSets grains(label_count(labels) + 1);
  for (const Seam& seam : measured_seams(labels, smooth, levels.background))
    if (is_one_grain(seam)) grains.join(seam.first, seam.second);
  for (int& label : labels.values) label = grains.root(label);
  number_labels(labels);
  return labels;
}

}  // namespace shape_pipeline
