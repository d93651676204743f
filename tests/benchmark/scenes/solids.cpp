// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmark/scenes/solids.h"

#include <array>
#include <cmath>
#include <numbers>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "tests/benchmark/scenes/hull_part.h"
#include "tests/benchmark/scenes/placing.h"

namespace benchmark_scenes {
namespace {

using catalog::ConvexFace;
using catalog::ConvexPart;
using catalog::FaceKind;
using dem_gpu::Shape;
using dem_gpu::Vec3;

void cover(ConvexPart& part, const Vec3& direction) { face_towards(part, direction).kind = FaceKind::inner; }

/// Cuts the side y = `y` of a box from x = `low` to `high` at x = `cut`: outer before the cut, covered behind it.
void cover_beyond(ConvexPart& box, double y, const std::array<double, 3>& low_cut_high, double half_thickness) {
  ConvexFace& bare = face_towards(box, {0, y, 0});
  const int first = static_cast<int>(box.vertices.size());
  for (const double x : low_cut_high)
    for (const double z : {-half_thickness, half_thickness}) box.vertices.push_back({x, y, z});
  ConvexFace covered{{first + 2, first + 4, first + 5, first + 3}, bare.plane, FaceKind::inner};
  bare.vertices = {first, first + 2, first + 3, first + 1};
  if (y > 0) {
    std::swap(bare.vertices[1], bare.vertices[3]);
    std::swap(covered.vertices[1], covered.vertices[3]);
  }
  box.faces.push_back(covered);
}

/// Parts scaled so that the sphere of their volume has that diameter.
Shape shape_of_diameter(const std::string& name, std::vector<ConvexPart> parts, double diameter) {
  double volume = 0;
  for (const ConvexPart& part : parts) volume += catalog::volume_moments(catalog::triangulated(part)).volume;
  const double scale = diameter / std::cbrt(6 * volume / std::numbers::pi);
  for (ConvexPart& part : parts) {
    for (catalog::Point& vertex : part.vertices) vertex = {scale * vertex[0], scale * vertex[1], scale * vertex[2]};
    for (ConvexFace& face : part.faces) face.plane.offset *= scale;
  }
  return dem_gpu::polyhedral_shape(name, parts);
}

Vec3 unit(const Vec3& v) { return v / norm(v); }

struct Shares {
  double low, high;
};
constexpr Shares kRough{0.92, 1.08};

/// Directions of the corners where parts of a rock meet, and the parts as three of them each.
struct Sectors {
  std::vector<Vec3> corners;
  std::vector<std::array<int, 3>> parts;
  int seam_corners;  // between two corners, on the seam
  Shares seam;       // of the ellipsoid's radius that they stand at: low enough for valleys, high enough to show
};

Sectors sectors_of(int parts) {
  if (parts == 4)
    return {{unit({1, 1, 1}), unit({1, -1, -1}), unit({-1, 1, -1}), unit({-1, -1, 1})},
            {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}},
            2,
            kRough};
  if (parts == 8)
    return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            {{0, 2, 4}, {1, 2, 4}, {0, 3, 4}, {1, 3, 4}, {0, 2, 5}, {1, 2, 5}, {0, 3, 5}, {1, 3, 5}},
            1,
            {0.76, 0.98}};
  throw catalog::InputError("benchmark scene: rocks are of 4 or 8 parts");
}

/// Corners of one rock: the same direction has the same corner in every part.
class RockSurface {
 public:
  explicit RockSurface(std::uint64_t seed) : seed_(seed) {}
  Vec3 corner(const Vec3& direction, const Shares& shares = kRough) const {
    const Vec3 u = unit(direction);
    // From the direction, whatever the order in which parts ask, rounded so that both neighbours name it alike.
    std::seed_seq key{static_cast<std::uint32_t>(seed_), place(u.x), place(u.y), place(u.z)};
    std::mt19937_64 random(key);
    const double on_ellipsoid = 1 / norm(Vec3{u.x, u.y / 0.85, u.z / 0.7});
    return on_ellipsoid * uniform(random, shares.low, shares.high) * u;
  }

 private:
  static std::uint32_t place(double x) { return static_cast<std::uint32_t>(std::lround(1e4 * x) + 100000); }
  std::uint64_t seed_;
};

/// The plane through the centre and two corners as both neighbours write it.
void meet_exactly(ConvexPart& part, const Vec3& from, const Vec3& to) {
  Vec3 normal = unit(cross(from, to));
  ConvexFace& faced = face_towards(part, normal);
  ConvexFace& turned = face_towards(part, -normal);
  const auto along = [&](const ConvexFace& face) {
    return dot(Vec3{face.plane.normal[0], face.plane.normal[1], face.plane.normal[2]}, normal);
  };
  const bool is_faced = along(faced) > -along(turned);
  ConvexFace& seam = is_faced ? faced : turned;
  if (!is_faced) normal = -normal;
  seam.plane = {{normal.x, normal.y, normal.z}, 0};
  seam.kind = FaceKind::inner;
}

ConvexPart rock_part(const Sectors& sectors, const std::array<int, 3>& corners, const RockSurface& surface) {
  std::vector<Vec3> points{{}};
  Vec3 middle;
  for (const int c : corners) {
    points.push_back(surface.corner(sectors.corners[c]));
    middle += sectors.corners[c];
  }
  points.push_back(surface.corner(middle));
  std::array<std::array<int, 2>, 3> seams{
      {{corners[0], corners[1]}, {corners[0], corners[2]}, {corners[1], corners[2]}}};
  for (const auto& [a, b] : seams) {
    const Vec3 &from = sectors.corners[a], &to = sectors.corners[b];
    for (int s = 1; s <= sectors.seam_corners; ++s)
      points.push_back(surface.corner((sectors.seam_corners + 1 - s) * from + s * to, sectors.seam));
    if (sectors.seam_corners > 1) points.push_back(surface.corner(from + to + 0.7 * unit(middle)));
  }
  ConvexPart part = hull_part(points);
  for (const auto& [a, b] : seams) meet_exactly(part, sectors.corners[a], sectors.corners[b]);
  return part;
}

}  // namespace

Shape cube(double edge) { return dem_gpu::polyhedral_shape("cube", {dem_gpu::box_part({edge, edge, edge})}); }

Shape truncated_tetrahedron(double volume) {
  // All permutations of (3, 1, 1) with an even number of minus signs: edge sqrt(8), volume 23 sqrt(2) / 12 edge^3.
  const double scale = std::cbrt(volume / (23 * std::numbers::sqrt2 / 12 * std::pow(8, 1.5)));
  std::vector<Vec3> corners;
  for (const Vec3& signs : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}})
    for (const Vec3& p : {Vec3{3, 1, 1}, Vec3{1, 3, 1}, Vec3{1, 1, 3}})
      corners.push_back(scale * Vec3{signs.x * p.x, signs.y * p.y, signs.z * p.z});
  return dem_gpu::polyhedral_shape("truncated tetrahedron", {hull_part(corners)});
}

Shape three_cube_l(double edge) {
  const double h = edge / 2;
  // The middle one about the origin, one along x, one along y.
  ConvexPart middle = box_between({-h, -h, -h}, {h, h, h}), right = box_between({h, -h, -h}, {3 * h, h, h}),
             upper = box_between({-h, h, -h}, {h, 3 * h, h});
  cover(middle, {1, 0, 0});
  cover(middle, {0, 1, 0});
  cover(right, {-1, 0, 0});
  cover(upper, {0, -1, 0});
  return dem_gpu::polyhedral_shape("L", {middle, right, upper});
}

Shape four_part_cross(double edge) {
  const double h = edge / 2;
  ConvexPart bar = box_between({-3 * h, -h, -h}, {h, h, h}), right = box_between({h, -h, -h}, {3 * h, h, h}),
             lower = box_between({-h, -3 * h, -h}, {h, -h, h}), upper = box_between({-h, h, -h}, {h, 3 * h, h});
  cover(bar, {1, 0, 0});
  for (const double y : {-h, h}) cover_beyond(bar, y, {-3 * h, -h, h}, h);
  cover(right, {-1, 0, 0});
  cover(lower, {0, 1, 0});
  cover(upper, {0, -1, 0});
  return dem_gpu::polyhedral_shape("cross", {bar, right, lower, upper});
}

Shape rough_rock(int parts, double diameter, std::uint64_t seed) {
  const Sectors sectors = sectors_of(parts);
  const RockSurface surface(seed);
  std::vector<ConvexPart> pieces;
  for (const std::array<int, 3>& corners : sectors.parts) pieces.push_back(rock_part(sectors, corners, surface));
  return shape_of_diameter("rock of " + std::to_string(parts) + " parts", std::move(pieces), diameter);
}

Shape faceted_ball(int corners, double diameter) {
  // Golden spiral: Gonzalez, Math. Geosci. 42 (2010) 49.
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i) {
    const double z = 1 - (2 * i + 1) / static_cast<double>(corners), r = std::sqrt(1 - z * z);
    const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    points.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  return shape_of_diameter("ball of " + std::to_string(corners) + " corners", {hull_part(points)}, diameter);
}

}  // namespace benchmark_scenes
