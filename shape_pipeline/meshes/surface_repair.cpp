// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/meshes/surface_repair.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/meshes/hole_filling.h"
#include "shape_pipeline/meshes/self_intersections.h"
#include "shape_pipeline/meshes/soup_cleaning.h"
#include "shape_pipeline/meshes/soup_orientation.h"
#include "shape_pipeline/point_cloud.h"
#include "shape_pipeline/reading/scan_extent.h"
#include "shape_pipeline/solid_checks.h"
#include "shape_pipeline/surface_distance.h"
#include "shape_pipeline/surface_reconstruction.h"
#include "shape_pipeline/surfaces/alpha_wrap.h"
#include "shape_pipeline/surfaces/cloud_projection.h"
#include "shape_pipeline/surfaces/vector3.h"
#include "shape_pipeline/surfaces/winding_volume.h"

namespace shape_pipeline {
namespace {

constexpr double kWeldDistance = 1e-6;         // of the diagonal: single-precision files differ by less
constexpr int kElementLimit = 4000;            // surface elements of the winding number: 1 % at half a second
constexpr double kLeastHullRatio = 0.2;        // a closed mesh may be a thin or hollow-cheeked particle
constexpr double kLargestRecut = 0.005;        // relative volume change that removing self-intersections may cause
constexpr std::size_t kEnoughVertices = 2000;  // fewer are sampled on the faces before a surface is rebuilt from points
constexpr double kAlphaParts[] = {90, 65, 45, 30};  // alpha = diagonal / parts, fine to coarse
constexpr double kOffsetPart = 1.0 / 30;            // offset / alpha

void clean(Repair& repair) {
  repair.count("welded_vertices", weld_vertices(repair.mesh, 0), "vertices joined to an equal one");
  std::size_t degenerate = remove_degenerate_faces(repair.mesh);
  repair.count("shared_walls", remove_shared_walls(repair.mesh), "faces between bodies that share them removed");
  std::size_t doubled = remove_duplicate_faces(repair.mesh);
  if (!mesh_topology(repair.mesh).is_closed()) {
    repair.count("welded_near_vertices",
                 weld_vertices(repair.mesh, kWeldDistance * bounding_diagonal(repair.mesh.vertices)),
                 "vertices joined to one within a millionth of the diagonal");
    degenerate += remove_degenerate_faces(repair.mesh);
    doubled += remove_duplicate_faces(repair.mesh);
  }
  repair.count("degenerate_faces", degenerate, "faces without area removed");
  repair.count("duplicate_faces", doubled, "faces that stood twice removed");
}

void orient(Repair& repair) {
  const MeshTopology before = mesh_topology(repair.mesh);
  repair.count("non_manifold_edges", before.non_manifold_edges, "edges with more than two faces split");
  repair.count("misoriented_edges", before.misoriented_edges, "edges between faces turned against one another");
  const std::size_t vertices = repair.mesh.vertices.size();
  repair.mesh = oriented_manifold(repair.mesh);
  if (before.is_closed() && repair.mesh.vertices.size() > vertices)
    repair.count("non_manifold_vertices", repair.mesh.vertices.size() - vertices, "vertices split where fans touch");
}

void turn_outwards(catalog::TriangleMesh& mesh) {
  if (signed_volume(mesh) < 0)
    for (catalog::Triangle& face : mesh.faces) std::swap(face[1], face[2]);
}

void keep_largest_surface(Repair& repair) {
  LargestSurface largest = largest_surface(repair.mesh);
  if (largest.dropped == 0) return;
  repair.mesh = std::move(largest.mesh);
  repair.count("dropped_surfaces", largest.dropped, "separate pieces dropped, the largest surface kept");
  char line[160];
  std::snprintf(line, sizeof line, "the largest surface has %.1f %% of the area, expected at least 90 %%",
                100 * largest.area_share);
  repair.checks.push_back({"kept_area_share", largest.area_share >= kLeastKeptShare, largest.area_share, line});
}

void close_holes(Repair& repair) {
  if (mesh_topology(repair.mesh).boundary_edges == 0) return;
  const HoleFilling filling = fill_holes(repair.mesh);
  repair.count("filled_holes", filling.filled, "holes closed by a patch that continues the surface");
  const double share = filling.filled_area / surface_area(repair.mesh);
  char line[120];
  std::snprintf(line, sizeof line, "patches make up %.1f %% of the area, expected at most 20 %%", 100 * share);
  repair.checks.push_back({"filled_area_share", share <= kLargestFilledShare, share, line});
}

void remove_self_intersections(Repair& repair) {
  if (!mesh_topology(repair.mesh).is_closed()) return;
  const std::size_t found = count_self_intersections(repair.mesh);
  std::size_t left = found;
  if (found > 0) {
    const catalog::TriangleMesh recut = without_self_intersections(repair.mesh);
    const MeshTopology before = mesh_topology(repair.mesh), after = mesh_topology(recut);
    const double change = std::abs(signed_volume(recut) / signed_volume(repair.mesh) - 1);
    const std::size_t left_after = after.is_closed() ? count_self_intersections(recut) : found;
    if (after.is_closed() && after.euler_number == before.euler_number && change <= kLargestRecut &&
        left_after < found) {
      repair.mesh = recut;
      left = left_after;
      repair.count("self_intersections", found - left, "pairs of faces that cut one another recut");
    }
  }
  repair.checks.push_back(
      {"self_intersections", left == 0, static_cast<double>(left), "pairs of faces that cut one another, expected 0"});
}

/// Vertices with their area-weighted normals, so that a wrap can be drawn onto the mesh.
PointCloud as_cloud(const catalog::TriangleMesh& mesh) {
  PointCloud cloud{mesh.vertices, std::vector<Point>(mesh.vertices.size(), Point{})};
  for (const catalog::Triangle& face : mesh.faces) {
    const Point& origin = mesh.vertices[face[0]];
    const Point area = cross(subtract(mesh.vertices[face[1]], origin), subtract(mesh.vertices[face[2]], origin));
    for (const int v : face) cloud.normals[v] = add(cloud.normals[v], area);
  }
  for (Point& normal : cloud.normals) normal = normalized(normal);
  return cloud;
}

/// Vertices with normals, or samples of the faces where the vertices are too few to show the surface.
PointCloud points_of(const catalog::TriangleMesh& mesh) {
  if (mesh.vertices.size() >= kEnoughVertices) return as_cloud(mesh);
  PointCloud cloud;
  for (const SurfaceElement& sample : surface_samples(mesh)) {
    cloud.points.push_back(sample.centre);
    cloud.normals.push_back(normalized(sample.area));
  }
  return cloud;
}

/// Poisson surface of the mesh's points, for a mesh of many holes or of tangled shells. The faces give the normals;
/// where their noise leaves no solid, the points around each do.
Reconstruction rebuilt_from_points(const catalog::TriangleMesh& mesh, int genus) {
  ReconstructionOptions options;
  options.method = ReconstructionMethod::poisson;
  options.genus = genus;
  PointCloud cloud = points_of(mesh);
  Reconstruction rebuilt = reconstruct_surface(cloud, options);
  const bool is_oriented = std::all_of(rebuilt.checks.begin(), rebuilt.checks.end(), [](const catalog::Check& check) {
    return check.name != "given_normals" || check.passed;
  });
  // Where the mesh's own normals contradict its points, its patches are turned at random: nothing to build on.
  if (!is_oriented) rebuilt.refusal = "its faces are not turned alike";
  if (!is_oriented || rebuilt.refusal.empty()) return rebuilt;
  const std::string flaws = rebuilt.refusal;
  cloud.normals.clear();
  rebuilt = reconstruct_surface(cloud, options);
  if (rebuilt.refusal.empty())
    rebuilt.checks.insert(rebuilt.checks.begin(), {"face_normals", false, 0,
                                                   "with the normals of the faces " + flaws +
                                                       "; normals estimated from the points taken instead"});
  return rebuilt;
}

/// Where the repair left flaws: a surface from the mesh's points, as the scanner turned its faces (orienting torn
/// patches one by one may turn some inwards), else a wrap of its surfaces.
RepairedMesh made_anew(const catalog::TriangleMesh& unturned, const catalog::TriangleMesh& surfaces,
                       const std::string& flaws, const RepairOptions& options, SolidExpectation expectation,
                       RepairedMesh result) {
  const std::string replaced = options.wrapping == Wrapping::always ? "" : "repair left " + flaws;
  std::string tried = flaws;
  const auto accept = [&](catalog::TriangleMesh&& mesh, const char* instead) {
    result.mesh = std::move(mesh);
    if (!replaced.empty()) result.checks.push_back({"repaired_solid", false, 0, replaced + instead});
  };
  if (options.wrapping == Wrapping::where_repair_fails) {
    Reconstruction rebuilt = rebuilt_from_points(unturned, options.genus);
    if (rebuilt.refusal.empty()) {
      accept(std::move(rebuilt.mesh), "; rebuilt from its points instead");
      result.checks.insert(result.checks.end(), rebuilt.checks.begin(), rebuilt.checks.end());
      return result;
    }
    tried += "; " + rebuilt.refusal;
  }
  if (options.wrapping != Wrapping::never) {
    expectation.second_volume = winding_volume(surface_elements(surfaces, kElementLimit));
    std::string wrap_flaws;
    for (const double parts : kAlphaParts) {
      const double alpha = bounding_diagonal(surfaces.vertices) / parts;
      catalog::TriangleMesh wrap = projected_to_cloud(alpha_wrap(surfaces, alpha, kOffsetPart * alpha),
                                                      as_cloud(surfaces), mean_edge_length(surfaces));
      const std::vector<catalog::Check> verdict = solid_checks(wrap, expectation);
      wrap_flaws = failures(verdict);
      if (!wrap_flaws.empty()) continue;
      accept(std::move(wrap), "; alpha wrap taken instead");
      result.checks.push_back({"repair_alpha_wrap", true, alpha, "radius of the carving ball [m]"});
      result.checks.insert(result.checks.end(), verdict.begin(), verdict.end());
      return result;
    }
    tried += "; even the coarsest alpha wrap: " + wrap_flaws;
  }
  result.refusal = "the mesh cannot be made one right solid (" + tried + ")";
  return result;
}

constexpr std::size_t kDeviationSamples = 20000;  // of the input's surface: the mean to half a percent
constexpr double kLargestDeviation = 0.005;       // mean distance / diagonal: a repair that moves more is invention

}  // namespace

void Repair::count(const std::string& name, std::size_t number, const std::string& detail) {
  if (number > 0) checks.push_back({"repair_" + name, true, static_cast<double>(number), detail});
}

CleanedScan cleaned_scan(const catalog::TriangleMesh& scanned) {
  CleanedScan scan{{scanned, {}}, {}, false};
  clean(scan.repair);
  scan.was_closed = mesh_topology(scan.repair.mesh).is_closed();
  scan.unturned = scan.repair.mesh;
  orient(scan.repair);
  return scan;
}

RepairedMesh repaired_surface(CleanedScan scan, const RepairOptions& options) {
  Repair& repair = scan.repair;
  RepairedMesh result;
  if (repair.mesh.vertices.empty() || are_flat(repair.mesh.vertices)) {
    result.refusal = "the mesh cannot be made one right solid (all its points lie in one plane)";
    return result;
  }
  turn_outwards(repair.mesh);
  const catalog::TriangleMesh all_surfaces = repair.mesh;
  keep_largest_surface(repair);
  turn_outwards(repair.mesh);

  SolidExpectation expectation;
  expectation.genus = options.genus;
  expectation.least_hull_ratio = kLeastHullRatio;
  // A mesh that came closed has its exact volume; the second method then informs, since it is coarse on thin shapes.
  // One of several bodies goes without.
  if (!scan.was_closed || options.bodies == catalog::SeparateBodies::refuse)
    expectation.second_volume = winding_volume(surface_elements(repair.mesh, kElementLimit));
  close_holes(repair);
  turn_outwards(repair.mesh);
  remove_self_intersections(repair);

  std::vector<catalog::Check> verdict = solid_checks(repair.mesh, expectation);
  for (catalog::Check& check : verdict)
    if (scan.was_closed && check.name == "volume_second_method") {
      check.passed = true;
      check.detail += " (informs: the mesh came closed)";
    }
  std::vector<catalog::Check> decisive = verdict;
  for (const catalog::Check& check : repair.checks)
    if (check.name == "filled_area_share" || check.name == "kept_area_share") decisive.push_back(check);
  result.checks = repair.checks;
  if (all_passed(decisive) && options.wrapping != Wrapping::always) {
    result.mesh = std::move(repair.mesh);
    result.checks.insert(result.checks.end(), verdict.begin(), verdict.end());
    return result;
  }
  return made_anew(scan.unturned, all_surfaces, failures(decisive), options, expectation, std::move(result));
}

void add_deviation(const catalog::TriangleMesh& input, RepairedMesh& result) {
  const std::vector<SurfaceElement> samples = surface_samples(input);
  std::vector<Point> points;
  const std::size_t step = std::max<std::size_t>(1, samples.size() / kDeviationSamples);
  for (std::size_t i = 0; i < samples.size(); i += step) points.push_back(samples[i].centre);
  const catalog::SurfaceDistance deviation =
      distance_statistics(distances_to_surface(points, result.mesh), bounding_diagonal(input.vertices));
  const auto add = [&](const char* name, bool is_good, double share, const char* expectation) {
    char line[160];
    std::snprintf(line, sizeof line, "distance of the input to the result is %.4f %% of the diagonal%s", 100 * share,
                  expectation);
    result.checks.push_back({name, is_good, share, line});
  };
  add("deviation_mean", deviation.mean <= kLargestDeviation, deviation.mean, ", expected at most 0.5 %");
  add("deviation_95", true, deviation.percentile_95, " (95 % of the surface is nearer)");
  add("deviation_largest", true, deviation.largest, " at most");
}

}  // namespace shape_pipeline
