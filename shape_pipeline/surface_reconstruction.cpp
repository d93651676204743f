// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surface_reconstruction.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/solid_checks.h"
#include "shape_pipeline/surface_distance.h"
#include "shape_pipeline/surfaces/alpha_wrap.h"
#include "shape_pipeline/surfaces/cloud_cleaning.h"
#include "shape_pipeline/surfaces/cloud_normals.h"
#include "shape_pipeline/surfaces/cloud_projection.h"
#include "shape_pipeline/surfaces/nearest_points.h"
#include "shape_pipeline/surfaces/poisson_surface.h"
#include "shape_pipeline/surfaces/vector3.h"
#include "shape_pipeline/surfaces/winding_volume.h"

namespace shape_pipeline {
namespace {

constexpr std::size_t kPointLimit = 60000;  // beyond, a particle gains no detail that its mesh could keep
constexpr int kNormalNeighbours = 18;       // points of a tangent plane: less follows noise, more rounds edges
constexpr int kElementLimit = 4000;         // surface elements of the winding number: 1 % at half a second
constexpr double kNormalAgreement = 0.9;  // mean |cosine| between given and estimated normals for the given to be used
constexpr double kSameSideShare = 0.95;   // share of given normals on the same side as the estimated ones
constexpr double kAlphaPartsFine = 50;    // alpha = diagonal / parts, tried from fine to coarse: a fine wrap that
constexpr double kAlphaPartsCoarse = 4;   // slips through a gap fails its volume check, a coarse one bridges hollows
constexpr double kAlphaStep = 1.4;
constexpr double kOffsetPart = 1.0 / 30;  // offset / alpha: the wrap is drawn onto the cloud afterwards
constexpr double kGapDistance = 4;        // of a face to the nearest point / spacing, from which it spans a gap
constexpr double kLargestGapShare = 0.2;  // of the area: a surface invented beyond this is no scan
constexpr double kTrustedDistance = 0.5;  // mean distance of the cloud to its surface / spacing

std::string text(const char* format, double a, double b = 0) {
  char line[160];
  std::snprintf(line, sizeof line, format, a, b);
  return line;
}

void note(std::vector<catalog::Check>& checks, const std::string& name, std::size_t count, const std::string& detail) {
  checks.push_back({name, true, static_cast<double>(count), detail});
}

/// Turns all normals if they point into the solid: the divergence theorem's volume must be positive.
void turn_outwards(PointCloud& cloud) {
  double volume = 0;
  for (const SurfaceElement& element : surface_elements(cloud, kElementLimit))
    volume += dot(subtract(element.centre, cloud.points.front()), element.area);
  if (volume < 0)
    for (Point& normal : cloud.normals) normal = scaled(normal, -1);
}

/// The given normals if they lie along the estimated ones and on one side, else the estimated ones; outward.
PointCloud oriented(const PointCloud& cloud, std::vector<catalog::Check>& checks) {
  PointCloud estimated = with_estimated_normals({cloud.points, {}}, kNormalNeighbours);
  const std::size_t lost = cloud.points.size() - estimated.points.size();
  turn_outwards(estimated);
  if (lost > 0) note(checks, "unoriented_points", lost, "points dropped because their normal stayed without a side");
  if (!cloud.has_normals()) return estimated;

  PointCloud given = cloud;
  turn_outwards(given);
  const auto same = nearest_points(given.points, estimated.points, 1);
  double cosine_sum = 0, same_side = 0;
  for (std::size_t i = 0; i < estimated.points.size(); ++i) {
    const double cosine = dot(estimated.normals[i], given.normals[same[i].front()]);
    cosine_sum += std::abs(cosine);
    same_side += cosine > 0;
  }
  const auto count = static_cast<double>(estimated.points.size());
  const bool agrees = cosine_sum >= kNormalAgreement * count && same_side >= kSameSideShare * count;
  checks.push_back({"given_normals", agrees, cosine_sum / count,
                    std::string("mean |cosine| to normals estimated from the points, expected at least 0.9: ") +
                        (agrees ? "given normals used" : "estimated normals used instead")});
  return agrees ? given : estimated;
}

/// A candidate mesh with its checks; the best of them is the result.
struct Candidate {
  catalog::TriangleMesh mesh;
  std::vector<catalog::Check> checks;
};

/// Share of the area of faces that are far from every point.
catalog::Check gap_check(const catalog::TriangleMesh& mesh, const PointCloud& cloud, double spacing) {
  std::vector<Point> centres;
  for (const catalog::Triangle& face : mesh.faces)
    centres.push_back(
        scaled(add(add(mesh.vertices[face[0]], mesh.vertices[face[1]]), mesh.vertices[face[2]]), 1.0 / 3));
  const auto nearest = nearest_points(cloud.points, centres, 1);
  double gap_area = 0, area = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Point& origin = mesh.vertices[mesh.faces[f][0]];
    const double face_area = norm(
        cross(subtract(mesh.vertices[mesh.faces[f][1]], origin), subtract(mesh.vertices[mesh.faces[f][2]], origin)));
    area += face_area;
    if (distance(centres[f], cloud.points[nearest[f].front()]) > kGapDistance * spacing) gap_area += face_area;
  }
  const double share = gap_area / area;
  return {"gap_area_share", share <= kLargestGapShare, share,
          text("%.1f %% of the area spans gaps in the cloud, expected at most %.0f %%", 100 * share,
               100 * kLargestGapShare)};
}

Candidate judged(catalog::TriangleMesh mesh, const std::string& method, const PointCloud& cloud, double spacing,
                 const SolidExpectation& expectation) {
  Candidate candidate;
  // Islands that Poisson leaves in noise are dropped.
  mesh = largest_surface(mesh).mesh;
  candidate.checks = solid_checks(mesh, expectation);
  if (!mesh.faces.empty()) {
    const std::vector<double> distances = distances_to_surface(cloud.points, mesh);
    double sum = 0;
    for (const double d : distances) sum += d;
    const double mean = sum / static_cast<double>(distances.size());
    candidate.checks.push_back({"cloud_distance_mean", mean <= kTrustedDistance * spacing, mean,
                                text("mean distance of the cloud to its surface %.3g m, expected at most %.3g m", mean,
                                     kTrustedDistance * spacing)});
    candidate.checks.push_back(gap_check(mesh, cloud, spacing));
  }
  candidate.checks.push_back({"reconstruction_" + method, true, static_cast<double>(mesh.faces.size()),
                              "faces of the surface by " + method + " (figure)"});
  candidate.mesh = std::move(mesh);
  return candidate;
}

}  // namespace

double average_spacing(const std::vector<catalog::Point>& points) {
  constexpr int kNeighbours = 6;
  const auto neighbours = nearest_points(points, points, kNeighbours + 1);
  double sum = 0;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const int n : neighbours[i]) {
      if (n == static_cast<int>(i)) continue;
      sum += distance(points[i], points[n]);
      ++pairs;
    }
  return pairs > 0 ? sum / static_cast<double>(pairs) : 0;
}

Reconstruction reconstruct_surface(const PointCloud& scanned, const ReconstructionOptions& options) {
  Reconstruction result;
  PointCloud cloud = scanned;
  note(result.checks, "cloud_points", cloud.points.size(), "points read");
  note(result.checks, "merged_duplicates", merge_duplicate_points(cloud), "points merged with an equal one");
  note(result.checks, "removed_outliers", remove_outliers(cloud), "points far from all others removed");
  if (cloud.points.size() > kPointLimit)
    note(result.checks, "thinned_points", thin_out(cloud, kPointLimit), "points left out where they are dense");
  cloud = oriented(cloud, result.checks);
  const double spacing = average_spacing(cloud.points);
  result.checks.push_back({"average_spacing", true, spacing, "mean distance to the six nearest points [m]"});

  SolidExpectation expectation;
  expectation.genus = options.genus;
  expectation.second_volume = winding_volume(surface_elements(cloud, kElementLimit));

  const auto accept = [&](Candidate& candidate) {
    result.mesh = std::move(candidate.mesh);
    result.checks.insert(result.checks.end(), candidate.checks.begin(), candidate.checks.end());
  };
  std::string tried;
  if (options.method != ReconstructionMethod::alpha_wrap) {
    const catalog::TriangleMesh surface = balanced_on_cloud(poisson_surface(cloud, spacing, {}), cloud, spacing);
    Candidate candidate = judged(surface, "poisson", cloud, spacing, expectation);
    const std::string flaws = failures(candidate.checks);
    if (flaws.empty()) {
      accept(candidate);
      return result;
    }
    tried = "Poisson: " + flaws;
    result.checks.push_back({"poisson_solid", false, 0, tried + "; alpha wrap taken instead"});
  }
  if (options.method != ReconstructionMethod::poisson) {
    std::string wrap_flaws;
    for (double parts = kAlphaPartsFine; parts >= kAlphaPartsCoarse; parts /= kAlphaStep) {
      const double alpha = bounding_diagonal(cloud.points) / parts;
      const catalog::TriangleMesh wrap = alpha_wrap(cloud.points, alpha, kOffsetPart * alpha);
      Candidate candidate = judged(balanced_on_cloud(projected_to_cloud(wrap, cloud, spacing), cloud, spacing),
                                   "alpha_wrap", cloud, spacing, expectation);
      wrap_flaws = failures(candidate.checks);
      if (!wrap_flaws.empty()) continue;
      accept(candidate);
      result.checks.push_back({"alpha_wrap_alpha", true, alpha, "radius of the carving ball [m]"});
      return result;
    }
    tried += (tried.empty() ? "" : "; ") + ("coarsest alpha wrap: " + wrap_flaws);
  }
  result.refusal = "the points give no right solid (" + tried + ")";
  return result;
}

}  // namespace shape_pipeline
