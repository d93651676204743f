// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/virtual_scan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "catalog/mass_properties.h"
#include "shape_pipeline/cloud_file.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/surfaces/random_stream.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr int kBumpWaves = 24;        // plane waves that make up the bumps
constexpr double kNotchWidth = 0.45;  // of the hollow, Gaussian half angle [rad]

catalog::TriangleMesh icosahedron() {
  constexpr double g = std::numbers::phi;
  catalog::TriangleMesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Point& p : mesh.vertices) p = normalized(p);
  return mesh;
}

/// Each face becomes four, new vertices on the unit sphere.
void subdivide(catalog::TriangleMesh& sphere) {
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [entry, is_new] =
        middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(sphere.vertices.size()));
    if (is_new) sphere.vertices.push_back(normalized(add(sphere.vertices[a], sphere.vertices[b])));
    return entry->second;
  };
  std::vector<catalog::Triangle> faces;
  for (const auto& [a, b, c] : sphere.faces) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    faces.insert(faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  sphere.faces = std::move(faces);
}

struct Wave {
  Point number;  // [rad]
  double phase, height;
};

std::vector<Wave> bump_waves(double roughness, RandomStream& random) {
  std::vector<Wave> waves;
  for (int w = 0; w < kBumpWaves; ++w) {
    // Heights fall with the wave number, as on fractured rock.
    const double number = random.uniform(4, 22);
    waves.push_back(
        {scaled(random.direction(), number), random.uniform(0, 2 * std::numbers::pi), roughness * 4 / number});
  }
  return waves;
}

struct HalfSpace {
  Point normal;
  double offset;
};

/// Normals spread over the sphere along a spiral and shaken, so that the intersection is always bounded.
std::vector<HalfSpace> random_half_spaces(int count, RandomStream& random) {
  std::vector<HalfSpace> half_spaces;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2.0 * k + 1) / count, r = std::sqrt(1 - z * z);
    const double angle = k * std::numbers::pi * (3 - std::sqrt(5.0));
    const Point even{r * std::cos(angle), r * std::sin(angle), z};
    const Point normal = normalized(add(even, scaled(random.direction(), 0.35)));
    half_spaces.push_back({normal, random.uniform(0.8, 1.0)});
  }
  return half_spaces;
}

}  // namespace

catalog::TriangleMesh virtual_rock(const RockRecipe& recipe) {
  RandomStream random(recipe.seed);
  const std::vector<HalfSpace> half_spaces = random_half_spaces(recipe.facets, random);
  const std::vector<Wave> waves = bump_waves(recipe.roughness, random);
  const Point notch = random.direction();

  catalog::TriangleMesh mesh = icosahedron();
  for (int level = 0; level < recipe.subdivisions; ++level) subdivide(mesh);
  for (Point& vertex : mesh.vertices) {
    const Point direction = vertex;
    // A p-norm of the half-spaces' reciprocals rounds the edge where two of them meet.
    double sum = 0;
    for (const HalfSpace& side : half_spaces)
      sum += std::pow(std::max(0.0, dot(side.normal, direction)) / side.offset, recipe.angularity);
    double radius = std::pow(sum, -1 / recipe.angularity);
    for (const Wave& wave : waves) radius += wave.height * std::cos(dot(wave.number, direction) + wave.phase);
    const double angle = std::acos(std::clamp(dot(direction, notch), -1.0, 1.0)) / kNotchWidth;
    radius *= 1 - recipe.notch_depth * std::exp(-angle * angle);
    const Point p = scaled(direction, radius * recipe.size / 2);
    vertex = {p[0] / recipe.elongation, p[1], p[2] * recipe.flatness};
  }
  return mesh;
}

PointCloud virtual_scan(const catalog::TriangleMesh& mesh, const ScannerFlaws& flaws) {
  RandomStream random(flaws.seed);
  std::vector<double> cumulative_area;
  double area = 0;
  for (const catalog::Triangle& face : mesh.faces) {
    const Point& origin = mesh.vertices[face[0]];
    area += norm(cross(subtract(mesh.vertices[face[1]], origin), subtract(mesh.vertices[face[2]], origin))) / 2;
    cumulative_area.push_back(area);
  }
  const Point centre = catalog::mass_properties(mesh).centroid;
  const Point gap = random.direction();

  PointCloud cloud;
  for (int i = 0; i < flaws.points; ++i) {
    const auto place = std::upper_bound(cumulative_area.begin(), cumulative_area.end(), random.uniform() * area);
    const auto face = std::min<std::size_t>(place - cumulative_area.begin(), mesh.faces.size() - 1);
    // Even over the triangle: fold the unit square's upper half back.
    double a = random.uniform(), b = random.uniform();
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const auto& [v0, v1, v2] = mesh.faces[face];
    const Point& origin = mesh.vertices[v0];
    Point p = add(origin,
                  add(scaled(subtract(mesh.vertices[v1], origin), a), scaled(subtract(mesh.vertices[v2], origin), b)));
    const bool is_missed = dot(normalized(subtract(p, centre)), gap) > std::cos(flaws.gap_angle);
    for (double& coordinate : p) coordinate += flaws.noise_sigma * random.normal();
    if (!is_missed) cloud.points.push_back(p);
  }
  const double reach = bounding_diagonal(mesh.vertices) / 2;
  for (int i = 0; i < flaws.stray_points; ++i)
    cloud.points.push_back(add(centre, scaled(random.direction(), reach * random.uniform(1.3, 1.8))));
  return cloud;
}

std::vector<std::filesystem::path> write_virtual_scans(const std::filesystem::path& folder, const VirtualScanSet& set) {
  std::filesystem::create_directories(folder);
  std::vector<std::filesystem::path> files;
  nlohmann::ordered_json scans = nlohmann::ordered_json::array();
  RandomStream random(set.seed);
  for (int k = 0; k < set.count; ++k) {
    RockRecipe recipe;
    recipe.seed = random.bits();
    recipe.flatness = random.uniform(0.65, 0.95);
    recipe.elongation = random.uniform(0.65, 0.95);
    recipe.facets = static_cast<int>(random.uniform(10, 19));
    recipe.angularity = random.uniform(14, 40);
    recipe.roughness = random.uniform(0.005, 0.02);
    recipe.notch_depth = k % 2 == 1 ? random.uniform(0.25, 0.4) : 0;
    const catalog::TriangleMesh rock = virtual_rock(recipe);
    ScannerFlaws flaws = set.flaws;
    flaws.seed = random.bits();

    char name[40];
    std::snprintf(name, sizeof name, "rock_%02d.ply", k + 1);
    files.push_back(folder / name);
    write_cloud(files.back(), virtual_scan(rock, flaws));
    scans.push_back({{"file", name},
                     {"volume", signed_volume(rock)},
                     {"surface_area", surface_area(rock)},
                     {"noise_sigma", flaws.noise_sigma},
                     {"gap_angle", flaws.gap_angle},
                     {"notch_depth", recipe.notch_depth},
                     {"seed", recipe.seed}});
  }
  const nlohmann::ordered_json truth{{"unit", "m"}, {"seed", set.seed}, {"scans", scans}};
  const std::filesystem::path path = folder / "truth.json", beside = folder / "truth.json.part";
  {
    std::ofstream stream(beside, std::ios::binary);
    stream << truth.dump(2) << '\n';
    if (!stream.flush()) refuse_file(path, "", "cannot be written", "check the folder and the space on the disk");
  }
  std::filesystem::rename(beside, path);
  return files;
}

std::map<std::string, ScanTruth> read_truth(const std::filesystem::path& path) {
  constexpr char kExpectation[] =
      "expected {\"scans\": [{\"file\": \"rock_01.ply\", \"volume\": [m3], \"surface_area\": [m2]}, ...]}";
  const nlohmann::json truth = nlohmann::json::parse(ScanBytes(path).view(), nullptr, false);
  if (truth.is_discarded() || !truth.is_object() || !truth.contains("scans") || !truth["scans"].is_array())
    refuse_file(path, "", kExpectation, "write the known volumes and areas in SI units");
  std::map<std::string, ScanTruth> result;
  for (const nlohmann::json& scan : truth["scans"]) {
    const std::string place = "scans[" + std::to_string(result.size()) + "]";
    const auto number = [&](const char* key) {
      return scan.is_object() && scan.contains(key) && scan[key].is_number() ? scan[key].get<double>() : 0.0;
    };
    if (!scan.is_object() || !scan.contains("file") || !scan["file"].is_string() || !(number("volume") > 0) ||
        !(number("surface_area") > 0))
      refuse_file(path, place, kExpectation, "complete the entry");
    result[scan["file"].get<std::string>()] = {number("volume"), number("surface_area"), number("noise_sigma")};
  }
  return result;
}

}  // namespace shape_pipeline
