// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/micrographs/distance_basins.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shape_pipeline/micrographs/image_filters.h"
#include "shape_pipeline/micrographs/label_sets.h"

namespace shape_pipeline {
namespace {

constexpr float kSaddleShare = 0.97f;  // of the lower peak
constexpr float kSaddleDepth = 0.5f;   // [pixels]; less is the grain of the pixels
constexpr float kCapShare = 0.5f;      // of the radius of the basin's largest disc
constexpr float kDiagonal = 1.41421356f;

struct Step {
  int dx, dy;
  float length;
};
constexpr std::array<Step, 8> kSteps{{{-1, -1, kDiagonal},
                                      {0, -1, 1},
                                      {1, -1, kDiagonal},
                                      {-1, 0, 1},
                                      {1, 0, 1},
                                      {-1, 1, kDiagonal},
                                      {0, 1, 1},
                                      {1, 1, kDiagonal}}};

/// Pixels of positive distance, the deepest first.
std::vector<std::size_t> by_depth(const DistanceImage& distance) {
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < distance.values.size(); ++i)
    if (distance.values[i] > 0) pixels.push_back(i);
  std::stable_sort(pixels.begin(), pixels.end(),
                   [&](std::size_t a, std::size_t b) { return distance.values[a] > distance.values[b]; });
  return pixels;
}

LabelImage flooded_basins(const DistanceImage& distance) {
  LabelImage labels(distance.width, distance.height);
  LabelSets basins(1);
  std::vector<float> peaks{0};
  const auto peak = [&](int basin) { return peaks[static_cast<std::size_t>(basin)]; };
  for (const std::size_t i : by_depth(distance)) {
    const int x = labels.x_of(i), y = labels.y_of(i);
    const float depth = distance.values[i];
    float steepest = -1;
    for (const Step& step : kSteps) {
      if (!labels.has(x + step.dx, y + step.dy) || !labels(x + step.dx, y + step.dy)) continue;
      const float rise = (distance(x + step.dx, y + step.dy) - depth) / step.length;
      if (rise <= steepest) continue;
      steepest = rise;
      labels.values[i] = labels(x + step.dx, y + step.dy);
    }
    if (!labels.values[i]) {
      labels.values[i] = basins.add();
      peaks.push_back(depth);
      continue;
    }
    for (const Step& step : kSteps) {
      if (!labels.has(x + step.dx, y + step.dy) || !labels(x + step.dx, y + step.dy)) continue;
      int high = basins.root(labels.values[i]), low = basins.root(labels(x + step.dx, y + step.dy));
      if (high == low) continue;
      if (peak(high) < peak(low)) std::swap(high, low);
      if (depth > kSaddleShare * peak(low) || peak(low) - depth < kSaddleDepth) basins.join(low, high);
    }
  }
  for (int& label : labels.values)
    if (label) label = basins.root(label);
  return labels;
}

/// Centres of discs that no neighbour's disc holds, the smallest first.
std::vector<std::size_t> disc_centres(const DistanceImage& distance) {
  std::vector<std::size_t> centres;
  for (std::size_t i = 0; i < distance.values.size(); ++i) {
    const float radius = distance.values[i];
    const int x = distance.x_of(i), y = distance.y_of(i);
    constexpr float kRounding = 1e-4f;
    const auto holds = [&](const Step& step) {
      return distance.has(x + step.dx, y + step.dy) &&
             distance(x + step.dx, y + step.dy) >= radius + step.length - kRounding;
    };
    if (radius > 0 && std::none_of(kSteps.begin(), kSteps.end(), holds)) centres.push_back(i);
  }
  std::stable_sort(centres.begin(), centres.end(),
                   [&](std::size_t a, std::size_t b) { return distance.values[a] < distance.values[b]; });
  return centres;
}

/// Of each pixel, the radius of the largest disc inside the mask that holds it and has its centre in the same basin.
DistanceImage largest_discs(const DistanceImage& distance, const LabelImage& labels) {
  DistanceImage radii(distance.width, distance.height);
  for (const std::size_t i : disc_centres(distance)) {
    const float radius = distance.values[i];
    const int x = distance.x_of(i), y = distance.y_of(i), reach = static_cast<int>(radius);
    for (int dy = std::max(-reach, -y); dy <= std::min(reach, distance.height - 1 - y); ++dy) {
      const int half = static_cast<int>(std::sqrt(std::max(0.0f, radius * radius - static_cast<float>(dy * dy))));
      for (int at = std::max(0, x - half); at <= std::min(distance.width - 1, x + half); ++at)
        if (labels(at, y + dy) == labels.values[i]) radii(at, y + dy) = radius;
    }
  }
  return radii;
}

/// The pixels of one patch, joined by their sides, and half its width.
struct Patch {
  std::vector<std::size_t> pixels;
  float half_width = 0;
};

/// Takes the patch away from the marked pixels.
Patch patch_at(std::size_t start, Mask& marked, const DistanceImage& width, const LabelImage& labels) {
  Patch patch{{start}, 0};
  marked.values[start] = 0;
  for (std::size_t k = 0; k < patch.pixels.size(); ++k) {
    const std::size_t i = patch.pixels[k];
    patch.half_width = std::max(patch.half_width, width.values[i]);
    for (const Step& step : kSteps) {
      const int x = labels.x_of(i) + step.dx, y = labels.y_of(i) + step.dy;
      if (step.length > 1 || !labels.has(x, y) || !marked(x, y) || labels(x, y) != labels.values[i]) continue;
      marked(x, y) = 0;
      patch.pixels.push_back(labels.index(x, y));
    }
  }
  return patch;
}

/// Pixels that only small discs of their basin hold.
Mask cap_pixels(const LabelImage& labels, const DistanceImage& distance) {
  const DistanceImage radii = largest_discs(distance, labels);
  std::vector<float> largest(static_cast<std::size_t>(label_count(labels)) + 1, 0.0f);
  for (std::size_t i = 0; i < labels.values.size(); ++i) {
    float& radius = largest[static_cast<std::size_t>(labels.values[i])];
    radius = std::max(radius, distance.values[i]);
  }
  Mask caps(labels.width, labels.height);
  for (std::size_t i = 0; i < labels.values.size(); ++i)
    if (labels.values[i] && radii.values[i] < kCapShare * largest[static_cast<std::size_t>(labels.values[i])])
      caps.values[i] = 255;
  return caps;
}

}  // namespace

LabelImage distance_basins(const Mask& mask) {
  const DistanceImage distance = distance_to_outside(mask);
  LabelImage labels = flooded_basins(distance);
  number_labels(labels);
  part_patches(labels, cap_pixels(labels, distance), kLeastPatch);
  return labels;
}

void part_patches(LabelImage& labels, Mask marked, double width) {
  const DistanceImage depth = distance_to_outside(marked);
  int next = label_count(labels);
  for (std::size_t i = 0; i < labels.values.size(); ++i) {
    if (!marked.values[i]) continue;
    const Patch patch = patch_at(i, marked, depth, labels);
    if (2 * patch.half_width < width) continue;
    ++next;
    for (const std::size_t pixel : patch.pixels) labels.values[pixel] = next;
  }
}

int label_count(const LabelImage& labels) { return *std::max_element(labels.values.begin(), labels.values.end()); }

void number_labels(LabelImage& labels) {
  std::vector<int> numbers(static_cast<std::size_t>(label_count(labels)) + 1, 0);
  int next = 0;
  for (int& label : labels.values) {
    if (!label) continue;
    int& number = numbers[static_cast<std::size_t>(label)];
    if (!number) number = ++next;
    label = number;
  }
}

}  // namespace shape_pipeline
