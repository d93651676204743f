// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/surface_roughness.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr int kPlaces = 200;               // the median over them is known to 9 % of their spread
constexpr std::size_t kFewestPieces = 12;  // twice the terms of the polynomial
constexpr double kLongestEdge = 0.25;      // of a piece over the patch's radius
constexpr double kMostPieces = 400000;     // half a CPU second; thin bodies have more
constexpr double kFlat = 1e-12;            // of the patch's radius: what rounding leaves of a flat face

using Terms = Eigen::Matrix<double, 6, 1>;

Terms terms(double x, double y) { return (Terms() << 1, x, y, x * x, x * y, y * y).finished(); }

/// A face, or a piece of a large one.
struct Piece {
  std::array<Point, 3> corners;
  Point centre, area;  // area: normal times area, outward
};

/// Halved across its longest edge until that is short enough: slender faces stay few.
void add_pieces(const std::array<Point, 3>& corners, double longest_edge, std::vector<Piece>& pieces) {
  const auto& [a, b, c] = corners;
  const double ab = distance(a, b), bc = distance(b, c), ca = distance(c, a), longest = std::max({ab, bc, ca});
  if (longest <= longest_edge) {
    pieces.push_back({corners, scaled(add(add(a, b), c), 1.0 / 3), scaled(cross(subtract(b, a), subtract(c, a)), 0.5)});
    return;
  }
  // Turned so that the longest edge runs from the first corner to the second.
  const std::array<Point, 3> turned = longest == ab   ? corners
                                      : longest == bc ? std::array<Point, 3>{b, c, a}
                                                      : std::array<Point, 3>{c, a, b};
  const Point middle = scaled(add(turned[0], turned[1]), 0.5);
  add_pieces({turned[0], middle, turned[2]}, longest_edge, pieces);
  add_pieces({middle, turned[1], turned[2]}, longest_edge, pieces);
}

/// A piece in the frame of its patch: lengths over the patch's radius, z outwards.
struct LocalPiece {
  std::array<Point, 3> corners;
  Point centre;
  double area, slope_x, slope_y;  // area: seen along z, over which ISO 25178 integrates
};

/// The pieces about a place that are turned its way. The centres of all stand by themselves too: most pieces are far
/// away, and only their centres are then read.
std::vector<LocalPiece> patch_about(const std::vector<Piece>& pieces, const std::vector<Point>& centres,
                                    const Piece& place, double radius) {
  const Point up = normalized(place.area);
  const Point across = normalized(cross(up, std::abs(up[0]) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0}));
  const Point along = cross(up, across);
  const auto local = [&](const Point& p) {
    const Point arm = scaled(subtract(p, place.centre), 1 / radius);
    return Point{dot(arm, across), dot(arm, along), dot(arm, up)};
  };
  std::vector<LocalPiece> patch;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Point arm = subtract(centres[k], place.centre);
    if (dot(arm, arm) > radius * radius) continue;
    const Piece& piece = pieces[k];
    const double rise = dot(piece.area, up);
    if (rise <= 0) continue;
    patch.push_back({{local(piece.corners[0]), local(piece.corners[1]), local(piece.corners[2])},
                     local(piece.centre),
                     rise,
                     -dot(piece.area, across) / rise,
                     -dot(piece.area, along) / rise});
  }
  return patch;
}

/// Heights are taken at the corners, where a scan has its points: means over faces would smooth its noise.
SurfaceRoughness roughness_of(const std::vector<LocalPiece>& patch, double radius) {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Terms right = Terms::Zero();
  double area = 0;
  for (const LocalPiece& piece : patch) {
    area += piece.area;
    for (const Point& p : piece.corners) {
      const Terms t = terms(p[0], p[1]);
      normal += piece.area / 3 * t * t.transpose();
      right += piece.area / 3 * p[2] * t;
    }
  }
  const Terms form = normal.ldlt().solve(right);
  double first = 0, second = 0, third = 0, fourth = 0, slope = 0;
  for (const LocalPiece& piece : patch) {
    const double w = piece.area / area;
    for (const Point& p : piece.corners) {
      const double z = p[2] - form.dot(terms(p[0], p[1])), squared = z * z;
      first += w / 3 * std::abs(z);
      second += w / 3 * squared;
      third += w / 3 * squared * z;
      fourth += w / 3 * squared * squared;
    }
    const auto& [x, y, z] = piece.centre;
    const double dx = piece.slope_x - (form[1] + 2 * form[3] * x + form[4] * y);
    const double dy = piece.slope_y - (form[2] + form[4] * x + 2 * form[5] * y);
    slope += w * (dx * dx + dy * dy);
  }
  const double sq = std::sqrt(second);
  if (sq < kFlat) return {radius, 0, 0, 0, 3, 0};
  return {radius, radius * first, radius * sq, third / (sq * sq * sq), fourth / (second * second), std::sqrt(slope)};
}

double median(const std::vector<SurfaceRoughness>& patches, double SurfaceRoughness::*figure) {
  std::vector<double> values;
  for (const SurfaceRoughness& patch : patches) values.push_back(patch.*figure);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::optional<SurfaceRoughness> surface_roughness(const catalog::TriangleMesh& mesh, double patch_radius) {
  const double longest_edge = kLongestEdge * patch_radius, area = surface_area(mesh);
  if (area > kMostPieces * longest_edge * longest_edge / 4) return std::nullopt;
  std::vector<Piece> pieces;
  for (const catalog::Triangle& face : mesh.faces)
    add_pieces({mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]}, longest_edge, pieces);
  std::vector<Point> centres;
  for (const Piece& piece : pieces) centres.push_back(piece.centre);
  std::vector<SurfaceRoughness> patches;
  double passed = 0;
  int places = 0;
  for (const Piece& piece : pieces) {
    passed += norm(piece.area);
    if (passed < (places + 0.5) * area / kPlaces) continue;
    while ((places + 0.5) * area / kPlaces <= passed) ++places;
    const std::vector<LocalPiece> patch = patch_about(pieces, centres, piece, patch_radius);
    if (patch.size() >= kFewestPieces) patches.push_back(roughness_of(patch, patch_radius));
  }
  if (patches.size() < kPlaces / 2) return std::nullopt;
  return SurfaceRoughness{patch_radius,
                          median(patches, &SurfaceRoughness::sa),
                          median(patches, &SurfaceRoughness::sq),
                          median(patches, &SurfaceRoughness::ssk),
                          median(patches, &SurfaceRoughness::sku),
                          median(patches, &SurfaceRoughness::sdq)};
}

}  // namespace shape_pipeline
