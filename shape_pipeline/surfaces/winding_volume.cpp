// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/winding_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <tuple>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/nearest_points.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr int kCellsAlongLongest = 48;  // midpoint cells: the counting error is near 0.3 % of a blocky solid
constexpr double kMostPieces = 400000;  // of split triangles: a fan of slivers over the whole solid stays affordable
constexpr int kAreaNeighbours = 12;     // points that share a patch of cloud: enough to average uneven spacing

/// Merges elements by cells whose width leaves about `limit` of them on the surface.
std::vector<SurfaceElement> merged(const std::vector<SurfaceElement>& elements, int limit) {
  if (elements.size() <= static_cast<std::size_t>(limit)) return elements;
  double total_area = 0;
  for (const SurfaceElement& element : elements) total_area += norm(element.area);
  // A surface meets about 1.5 cells for each cell face's worth of area.
  const double width = std::sqrt(1.5 * total_area / limit);
  struct Cell {
    Point weighted_centre{}, area{};
    double weight = 0;
  };
  std::map<std::tuple<std::int64_t, std::int64_t, std::int64_t>, Cell> cells;
  for (const SurfaceElement& element : elements) {
    const auto index = [&](int i) { return static_cast<std::int64_t>(std::floor(element.centre[i] / width)); };
    Cell& cell = cells[{index(0), index(1), index(2)}];
    const double weight = norm(element.area);
    cell.weighted_centre = add(cell.weighted_centre, scaled(element.centre, weight));
    cell.area = add(cell.area, element.area);
    cell.weight += weight;
  }
  std::vector<SurfaceElement> result;
  for (const auto& [key, cell] : cells)
    if (cell.weight > 0) result.push_back({scaled(cell.weighted_centre, 1 / cell.weight), cell.area});
  return result;
}

using Corners = std::array<Point, 3>;

/// The corner from which a triangle's longest edge starts.
int longest_edge(const Corners& t) {
  const std::array<double, 3> lengths{distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])};
  return static_cast<int>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
}

double longest_edge_length(const Corners& t) {
  const int e = longest_edge(t);
  return distance(t[e], t[(e + 1) % 3]);
}

/// Edge length [m] to which the triangles are split: a cell's, or more where that would make too many pieces.
double split_length(const std::vector<Corners>& triangles) {
  Point low = triangles.front()[0], high = low;
  for (const Corners& triangle : triangles)
    for (const Point& corner : triangle)
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], corner[i]);
        high[i] = std::max(high[i], corner[i]);
      }
  const Point extent = subtract(high, low);
  double length = *std::max_element(extent.begin(), extent.end()) / kCellsAlongLongest;
  const auto pieces = [&] {
    double sum = 0;
    for (const Corners& t : triangles) {
      const double edges = longest_edge_length(t) / length;
      const double area = norm(cross(subtract(t[1], t[0]), subtract(t[2], t[0])));
      if (edges > 1) sum += 2 * edges + 4 * area / (length * length);
    }
    return sum;
  };
  while (length > 0 && pieces() > kMostPieces) length *= 1.5;
  return length;
}

/// Columns in single precision, so that the sum over elements runs in vector instructions.
struct ElementColumns {
  std::vector<float> x, y, z, area_x, area_y, area_z;

  float winding_number(float px, float py, float pz, float smallest_squared_distance) const {
    float sum = 0;
    const std::size_t count = x.size();
#pragma GCC ivdep
    for (std::size_t e = 0; e < count; ++e) {
      const float dx = x[e] - px, dy = y[e] - py, dz = z[e] - pz;
      const float squared = std::max(dx * dx + dy * dy + dz * dz, smallest_squared_distance);
      sum += (dx * area_x[e] + dy * area_y[e] + dz * area_z[e]) / (squared * std::sqrt(squared));
    }
    return sum / (4 * std::numbers::pi_v<float>);
  }
};

}  // namespace

std::vector<SurfaceElement> surface_samples(const catalog::TriangleMesh& soup) {
  std::vector<Corners> left;
  left.reserve(soup.faces.size());
  for (auto face = soup.faces.rbegin(); face != soup.faces.rend(); ++face)
    left.push_back({soup.vertices[(*face)[0]], soup.vertices[(*face)[1]], soup.vertices[(*face)[2]]});
  std::vector<SurfaceElement> elements;
  if (left.empty()) return elements;
  const double length = split_length(left);
  while (!left.empty()) {
    const Corners triangle = left.back();
    left.pop_back();
    const int e = longest_edge(triangle);
    const Point &a = triangle[e], &b = triangle[(e + 1) % 3], &c = triangle[(e + 2) % 3];
    if (length > 0 && distance(a, b) > length) {
      const Point middle = scaled(add(a, b), 0.5);
      left.push_back({a, middle, c});
      left.push_back({middle, b, c});
    } else {
      elements.push_back({scaled(add(add(a, b), c), 1.0 / 3), scaled(cross(subtract(b, a), subtract(c, a)), 0.5)});
    }
  }
  return elements;
}

std::vector<SurfaceElement> surface_elements(const catalog::TriangleMesh& soup, int limit) {
  return merged(surface_samples(soup), limit);
}

std::vector<SurfaceElement> surface_elements(const PointCloud& cloud, int limit) {
  std::vector<SurfaceElement> elements;
  elements.reserve(cloud.points.size());
  const auto neighbours = nearest_points(cloud.points, cloud.points, kAreaNeighbours + 1);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const double radius = distance(cloud.points[i], cloud.points[neighbours[i].back()]);
    const double area = std::numbers::pi * radius * radius / kAreaNeighbours;
    elements.push_back({cloud.points[i], scaled(cloud.normals[i], area)});
  }
  return merged(elements, limit);
}

double winding_volume(const std::vector<SurfaceElement>& elements) {
  if (elements.empty()) return 0;
  // Coordinates from the box's low corner in units of its longest side keep single precision exact enough.
  Point low = elements.front().centre, high = low;
  double total_area = 0;
  for (const SurfaceElement& element : elements) {
    total_area += norm(element.area);
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], element.centre[i]);
      high[i] = std::max(high[i], element.centre[i]);
    }
  }
  const Point extent = subtract(high, low);
  const double longest = *std::max_element(extent.begin(), extent.end());
  if (!(longest > 0) || !(total_area > 0)) return 0;
  ElementColumns columns;
  for (const SurfaceElement& element : elements) {
    const Point centre = scaled(subtract(element.centre, low), 1 / longest);
    const Point area = scaled(element.area, 1 / (longest * longest));
    columns.x.push_back(static_cast<float>(centre[0]));
    columns.y.push_back(static_cast<float>(centre[1]));
    columns.z.push_back(static_cast<float>(centre[2]));
    columns.area_x.push_back(static_cast<float>(area[0]));
    columns.area_y.push_back(static_cast<float>(area[1]));
    columns.area_z.push_back(static_cast<float>(area[2]));
  }
  // Nearer than half an element's width, an element is no point any more.
  const double element_area = total_area / (longest * longest) / static_cast<double>(elements.size());
  const auto smallest_squared_distance = static_cast<float>(element_area / 4);

  // Whole cells along each axis fit a thin box; unequal numbers keep oblique faces off the planes of the grid.
  std::array<int, 3> cells;
  std::array<float, 3> width;  // of a cell / longest
  for (int i = 0; i < 3; ++i) {
    cells[i] = i + std::max(1, static_cast<int>(std::ceil(extent[i] / longest * kCellsAlongLongest)));
    width[i] = static_cast<float>(extent[i] / longest / cells[i]);
  }
  std::vector<float> winding;
  winding.reserve(static_cast<std::size_t>(cells[0]) * cells[1] * cells[2]);
  for (int i = 0; i < cells[0]; ++i)
    for (int j = 0; j < cells[1]; ++j)
      for (int k = 0; k < cells[2]; ++k)
        winding.push_back(columns.winding_number((i + 0.5f) * width[0], (j + 0.5f) * width[1], (k + 0.5f) * width[2],
                                                 smallest_squared_distance));

  // The level inside is 1 for exact areas; for a cloud the areas are estimates with a common bias.
  std::vector<float> inside;
  for (const float w : winding)
    if (w > 0.5f) inside.push_back(w);
  if (inside.empty()) return 0;
  std::nth_element(inside.begin(), inside.begin() + inside.size() / 2, inside.end());
  const float threshold = inside[inside.size() / 2] / 2;
  const auto count = std::count_if(winding.begin(), winding.end(), [&](float w) { return w > threshold; });
  return static_cast<double>(count) / static_cast<double>(winding.size()) * extent[0] * extent[1] * extent[2];
}

}  // namespace shape_pipeline
