// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/micrographs/outline_tracing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "shape_pipeline/micrographs/distance_basins.h"
#include "shape_pipeline/micrographs/grain_seams.h"
#include "shape_pipeline/micrographs/image_filters.h"
#include "shape_pipeline/micrographs/plane_geometry.h"

namespace shape_pipeline {
namespace {

constexpr double kSeamSmoothing = 1.2;  // [pixels]; as on the seams of tomograms
constexpr float kSeamNear = 1e-3f;      // weight of other regions from which on there is a seam
constexpr int kMargin = 5;              // [pixels] about a region, beyond the reach of the smoothing

/// An edge of the grid of pixel centres: from the centre with this index, to the right or downwards.
struct GridEdge {
  std::size_t from = 0;
  bool is_down = false;
  friend auto operator<=>(const GridEdge&, const GridEdge&) = default;
};

/// The field with a frame that is outside.
Raster<float> framed(const Raster<float>& field) {
  Raster<float> result(field.width + 2, field.height + 2, -1.0f);
  for (int y = 0; y < field.height; ++y)
    for (int x = 0; x < field.width; ++x) result(x + 1, y + 1) = field(x, y);
  return result;
}

/// Steps of the zero line through the cells, from edge to edge, the inside to the right as seen.
std::map<GridEdge, GridEdge> zero_line(const Raster<float>& field) {
  std::map<GridEdge, GridEdge> next;
  for (int y = 0; y + 1 < field.height; ++y)
    for (int x = 0; x + 1 < field.width; ++x) {
      // Corners and sides in turn: upper left, upper right, lower right, lower left; top, right, bottom, left.
      const std::array<float, 4> corner{field(x, y), field(x + 1, y), field(x + 1, y + 1), field(x, y + 1)};
      const std::array<GridEdge, 4> side{{{field.index(x, y), false},
                                          {field.index(x + 1, y), true},
                                          {field.index(x, y + 1), false},
                                          {field.index(x, y), true}}};
      const bool joins = corner[0] + corner[1] + corner[2] + corner[3] > 0;
      std::array<int, 4> turns{};  // +1 where the walk round the cell comes in, -1 where it goes out
      int crossings = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        turns[k] = (corner[(k + 1) % 4] > 0) - (corner[k] > 0);
        crossings += turns[k] != 0;
      }
      for (std::size_t k = 0; k < 4; ++k) {
        if (turns[k] != -1) continue;
        // The line enters where the walk leaves the inside; in a saddle that joins it turns about the outer corner.
        std::size_t end = (k + 1) % 4;
        if (crossings != 4 || !joins)
          for (end = (k + 3) % 4; turns[end] != 1;) end = (end + 3) % 4;
        next[side[k]] = side[end];
      }
    }
  return next;
}

PlanePoint crossing(const Raster<float>& field, const GridEdge& edge) {
  const int x = field.x_of(edge.from), y = field.y_of(edge.from);
  const double a = field(x, y), b = edge.is_down ? field(x, y + 1) : field(x + 1, y), t = a / (a - b);
  // Half a pixel to the corner of the image, a whole one less for the frame.
  return {x - 0.5 + (edge.is_down ? 0 : t), y - 0.5 + (edge.is_down ? t : 0)};
}

struct Box {
  int left, top, right, bottom;  // ends included
};

std::vector<Box> region_boxes(const LabelImage& regions) {
  std::vector<Box> boxes(static_cast<std::size_t>(label_count(regions)) + 1, {regions.width, regions.height, 0, 0});
  for (int y = 0; y < regions.height; ++y)
    for (int x = 0; x < regions.width; ++x) {
      Box& box = boxes[static_cast<std::size_t>(regions(x, y))];
      box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x), std::max(box.bottom, y)};
    }
  for (Box& box : boxes)
    box = {std::max(0, box.left - kMargin), std::max(0, box.top - kMargin),
           std::min(regions.width - 1, box.right + kMargin), std::min(regions.height - 1, box.bottom + kMargin)};
  return boxes;
}

/// Grey of the background and of a region.
struct GreyRange {
  double low = 0, high = 0;
};

/// Positive inside of a region, in the pixels of its box.
Raster<float> region_field(const LabelImage& regions, const GreyImage& grey, const GreyRange& range, int label,
                           const Box& box) {
  const int width = box.right - box.left + 1, height = box.bottom - box.top + 1;
  GreyImage own(width, height), other(width, height), field(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int at = regions(box.left + x, box.top + y);
      own(x, y) = at == label ? 1 : 0;
      other(x, y) = at && at != label ? 1 : 0;
    }
  own = blurred(own, kSeamSmoothing);
  other = blurred(other, kSeamSmoothing);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double above = (grey(box.left + x, box.top + y) - range.low) / std::max(1e-3, range.high - range.low) - 0.5;
      field(x, y) = static_cast<float>(above);
      if (other(x, y) > kSeamNear) field(x, y) = std::min(field(x, y), own(x, y) - other(x, y));
    }
  return field;
}

}  // namespace

std::vector<Outline> level_lines(const Raster<float>& given) {
  const Raster<float> field = framed(given);
  std::map<GridEdge, GridEdge> next = zero_line(field);
  std::vector<Outline> lines;
  while (!next.empty()) {
    Outline line;
    for (auto step = next.begin(); step != next.end();) {
      const PlanePoint point = crossing(field, step->first);
      if (line.empty() || point != line.back()) line.push_back(point);
      const GridEdge to = step->second;
      next.erase(step);
      step = next.find(to);
    }
    if (line.size() > 1 && line.front() == line.back()) line.pop_back();
    if (line.size() >= 3) lines.push_back(std::move(line));
  }
  return lines;
}

Outline level_outline(const Raster<float>& field) {
  Outline best;
  double largest = 0;
  for (Outline& line : level_lines(field)) {
    const double area = std::abs(plane_moments(line).area);
    if (area <= largest) continue;
    largest = area;
    best = std::move(line);
  }
  return best;
}

std::vector<Outline> region_outlines(const LabelImage& regions, const GreyImage& grey, const GreyLevels& levels) {
  const std::vector<Box> boxes = region_boxes(regions);
  const std::vector<double> greys = region_greys(regions, grey);
  std::vector<Outline> outlines(boxes.size());
  for (std::size_t label = 1; label < boxes.size(); ++label) {
    outlines[label] = level_outline(
        region_field(regions, grey, {levels.background, greys[label]}, static_cast<int>(label), boxes[label]));
    for (PlanePoint& p : outlines[label]) p = {p[0] + boxes[label].left, p[1] + boxes[label].top};
  }
  return outlines;
}

}  // namespace shape_pipeline
