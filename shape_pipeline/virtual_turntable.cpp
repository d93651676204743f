// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/virtual_turntable.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "catalog/mass_properties.h"
#include "shape_pipeline/micrographs/image_file.h"
#include "shape_pipeline/micrographs/plane_geometry.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/silhouettes/mesh_silhouette.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double kDistance = 6;  // of a perspective camera, in sizes of the grain

using Interval = std::array<double, 2>;

catalog::TriangleMesh centred(catalog::TriangleMesh mesh) {
  const Point centre = catalog::mass_properties(mesh).centroid;
  for (Point& vertex : mesh.vertices) vertex = subtract(vertex, centre);
  return mesh;
}

/// The largest extent that any view may show [m].
double extent_of(const catalog::TriangleMesh& mesh) {
  double half = 0;
  for (const Point& p : mesh.vertices) half = std::max({half, std::hypot(p[0], p[1]), std::abs(p[2])});
  return 2 * half;
}

TurntableCamera camera_for(double extent, const TurntableRecipe& recipe) {
  TurntableCamera camera;
  camera.elevation = recipe.elevation;
  camera.is_perspective = recipe.is_perspective;
  if (recipe.is_perspective) {
    camera.distance = kDistance * extent;
    // What lies half an extent nearer is that much larger.
    camera.focal_length = recipe.fill * recipe.side * (kDistance - 0.5);
    camera.principal_point = {recipe.side / 2.0 + recipe.axis_offset, recipe.side / 2.0};
  } else {
    camera.pixel_size = extent / (recipe.fill * recipe.side);
  }
  return camera;
}

/// Points where the mesh's section at a height has its corners, two an edge of the section.
std::vector<std::array<PlanePoint, 2>> section_at(const catalog::TriangleMesh& mesh, double height) {
  std::vector<std::array<PlanePoint, 2>> edges;
  for (const catalog::Triangle& face : mesh.faces) {
    std::vector<PlanePoint> crossings;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point &a = mesh.vertices[static_cast<std::size_t>(face[k])],
                  &b = mesh.vertices[static_cast<std::size_t>(face[(k + 1) % 3])];
      if ((a[2] <= height) == (b[2] <= height)) continue;
      const double t = (height - a[2]) / (b[2] - a[2]);
      crossings.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
    if (crossings.size() == 2) edges.push_back({crossings[0], crossings[1]});
  }
  return edges;
}

/// What of the line across a view the section covers, in parts from left to right.
std::vector<Interval> shadow_of(const std::vector<std::array<PlanePoint, 2>>& section, const PlanePoint& across) {
  std::vector<Interval> pieces;
  for (const auto& [a, b] : section) {
    const double u = a[0] * across[0] + a[1] * across[1], v = b[0] * across[0] + b[1] * across[1];
    pieces.push_back({std::min(u, v), std::max(u, v)});
  }
  std::sort(pieces.begin(), pieces.end());
  std::vector<Interval> joined;
  for (const Interval& piece : pieces)
    if (joined.empty() || piece[0] > joined.back()[1] + 1e-9 * std::abs(joined.back()[1]))
      joined.push_back(piece);
    else
      joined.back()[1] = std::max(joined.back()[1], piece[1]);
  return joined;
}

/// A convex polygon less what lies beyond a line: sign * (p . across - bound) > 0 is cut away.
Outline clipped(const Outline& polygon, const PlanePoint& across, double bound, double sign) {
  const auto beyond = [&](const PlanePoint& p) { return sign * (p[0] * across[0] + p[1] * across[1] - bound); };
  Outline result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PlanePoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = beyond(a), db = beyond(b);
    if (da <= 0) result.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      const double t = da / (da - db);
      result.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
  }
  return result;
}

double best_section_area(const std::vector<std::array<PlanePoint, 2>>& section, int views, double half) {
  std::vector<Outline> polygons{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
  for (int k = 0; k < views; ++k) {
    const double angle = 2 * std::numbers::pi * k / views;
    const PlanePoint across{std::cos(angle), -std::sin(angle)};
    std::vector<Outline> kept;
    for (const Interval& part : shadow_of(section, across))
      for (const Outline& polygon : polygons) {
        Outline piece = clipped(clipped(polygon, across, part[0], -1), across, part[1], 1);
        if (piece.size() > 2) kept.push_back(std::move(piece));
      }
    polygons = std::move(kept);
  }
  double area = 0;
  for (const Outline& polygon : polygons) area += std::abs(plane_moments(polygon).area);
  return area;
}

}  // namespace

TurntableViews virtual_turntable(const catalog::TriangleMesh& mesh, const TurntableRecipe& recipe) {
  const catalog::TriangleMesh grain = centred(mesh);
  TurntableViews views;
  views.camera = camera_for(extent_of(grain), recipe);
  TurntableCamera known = views.camera;
  known.axis_column = recipe.side / 2.0 + recipe.axis_offset;
  RandomStream random(recipe.seed);
  const double ground = recipe.is_bright_grain ? recipe.dark : recipe.bright;
  const double figure = recipe.is_bright_grain ? recipe.bright : recipe.dark;
  const std::vector<double> angles = view_angles(known, static_cast<std::size_t>(recipe.views));
  for (std::size_t k = 0; k < angles.size(); ++k) {
    GreyImage image = mesh_coverage(grain, {known, angles[k], recipe.side}, recipe.side, recipe.side);
    for (float& value : image.values)
      value = static_cast<float>(
          std::clamp(std::round(ground + value * (figure - ground) + recipe.noise * random.normal()), 0.0, 255.0));
    views.names.push_back("view_" + std::to_string(k + 1) + ".png");
    views.images.push_back(std::move(image));
    views.refusals.emplace_back();
  }
  return views;
}

void write_turntable(const std::filesystem::path& folder, const TurntableViews& views) {
  std::filesystem::create_directories(folder);
  for (std::size_t k = 0; k < views.images.size(); ++k) write_image(folder / views.names[k], views.images[k]);
  const TurntableCamera& camera = views.camera;
  nlohmann::ordered_json sidecar{{"unit", "m"}, {"elevation", camera.elevation * 180 / std::numbers::pi}};
  if (camera.is_perspective) {
    sidecar["focal_length"] = camera.focal_length;
    sidecar["principal_point"] = camera.principal_point;
    sidecar["distance"] = camera.distance;
  } else {
    sidecar["pixel_size"] = camera.pixel_size;
  }
  std::ofstream file(folder / "turntable.json");
  file << sidecar.dump(2) << "\n";
  if (!file.flush())
    refuse_file(folder / "turntable.json", "", "cannot be written", "check the folder and the space left");
}

double best_hull_volume(const catalog::TriangleMesh& mesh, int views, int slices) {
  const auto [lowest, highest] = std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                                                     [](const Point& a, const Point& b) { return a[2] < b[2]; });
  const double low = (*lowest)[2], step = ((*highest)[2] - low) / slices;
  double half = 0;
  for (const Point& p : mesh.vertices) half = std::max({half, std::abs(p[0]), std::abs(p[1])});
  double volume = 0;
  for (int s = 0; s < slices; ++s)
    volume += step * best_section_area(section_at(mesh, low + (s + 0.5) * step), views, 2 * half);
  return volume;
}

}  // namespace shape_pipeline
