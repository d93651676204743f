// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/partition_start.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <set>

#include "decomposition/fit/joint_fit.h"
#include "decomposition/fit/joint_misfit.h"
#include "decomposition/geometry/convex_polygon.h"

namespace decomposition {
namespace {

constexpr int kSectionSamples = 64;  // squared: places looked at on a cut
constexpr int kFewestCorners = 5, kMostCorners = 24;

std::vector<CutSide> sides_of(const Cell& cell, const std::vector<Plane>& cuts) {
  std::vector<CutSide> sides;
  for (std::size_t k = 0; k < cell.planes.size(); ++k)
    sides.push_back(
        {cell.cuts[k], dot(cell.planes[k].normal, cuts[static_cast<std::size_t>(cell.cuts[k])].normal) < 0});
  return sides;
}

bool is_inside(const Vec3& p, const std::vector<Plane>& cell, double margin) {
  return std::all_of(cell.begin(), cell.end(), [&](const Plane& plane) { return plane.signed_distance(p) <= -margin; });
}

/// Usual distance between neighbouring vertices of a part of that volume with so many: near-regular triangles on a
/// ball, with a little more surface.
double vertex_spacing(double volume, int vertices) {
  const double area = 1.15 * std::cbrt(36 * std::numbers::pi * volume * volume);
  return std::sqrt(2 * area / (std::sqrt(3.0) * vertices));
}

/// Places on a cut that lie in the solid, and the leaves on its two sides there.
struct FilledPlace {
  Point2 at;
  int leaf[2];
};

/// A grid on a cut's plane over the whole solid.
struct CutGrid {
  Vec3 u, v, origin;
  double pitch;

  CutGrid(const Solid& solid, const Plane& plane) : pitch(solid.diagonal() / kSectionSamples) {
    plane_axes(plane.normal, u, v);
    const Box box = bounding_box(solid.vertices());
    const Vec3 middle = 0.5 * (box.low + box.high);
    origin = middle - plane.signed_distance(middle) * plane.normal;
  }
  Vec3 operator()(const Point2& p) const { return origin + p[0] * u + p[1] * v; }
  Point2 place(int i, int j) const {
    return {(i + 0.5 - 0.5 * kSectionSamples) * pitch, (j + 0.5 - 0.5 * kSectionSamples) * pitch};
  }
};

/// Numbers of sets that grow together.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int of(int k) {
    while (parent_[static_cast<std::size_t>(k)] != k) k = parent_[static_cast<std::size_t>(k)];
    return k;
  }
  void join(int a, int b) { parent_[static_cast<std::size_t>(std::max(of(a), of(b)))] = std::min(of(a), of(b)); }

 private:
  std::vector<int> parent_;
};

/// Corners of a section of which some places are known: on the ellipse of inertia of the places, moved to the surface.
std::vector<Vec3> section_corners(const Solid& solid, const CutGrid& grid, const std::vector<Point2>& places,
                                  const std::vector<Plane>& cell, double spacing) {
  const double count = static_cast<double>(places.size());
  double uu = 0, uv = 0, vv = 0;
  Point2 mean{};
  for (const Point2& p : places) mean[0] += p[0] / count, mean[1] += p[1] / count;
  for (const Point2& p : places) {
    const double x = p[0] - mean[0], y = p[1] - mean[1];
    uu += x * x / count, uv += x * y / count, vv += y * y / count;
  }
  const double half = (uu + vv) / 2, spread = std::hypot((uu - vv) / 2, uv), angle = 0.5 * std::atan2(2 * uv, uu - vv);
  // A uniform ellipse of semi-axis s has the variance s^2 / 4 along it; a row of single places is a pitch wide.
  const double least = grid.pitch * grid.pitch / 12;
  const double a = 2 * std::sqrt(std::fmax(half + spread, least)), b = 2 * std::sqrt(std::fmax(half - spread, least));
  const double around = 2 * std::numbers::pi * std::sqrt((a * a + b * b) / 2);
  const int corners = std::clamp(static_cast<int>(std::lround(around / spacing)), kFewestCorners, kMostCorners);
  const Vec3 centre = grid(mean);
  const Vec3 long_axis = std::cos(angle) * grid.u + std::sin(angle) * grid.v;
  const Vec3 short_axis = -std::sin(angle) * grid.u + std::cos(angle) * grid.v;
  std::vector<Vec3> result;
  for (int k = 0; k < corners; ++k) {
    const double turn = 2 * std::numbers::pi * (k + 0.5) / corners;
    const Vec3 reach = (a * std::cos(turn)) * long_axis + (b * std::sin(turn)) * short_axis;
    const double march = solid.cell() / norm(reach);
    const auto filled = [&](double t) { return solid.occupancy(centre + t * reach) > 0.5; };
    double t = 1;
    if (filled(t))
      while (t < 1.6 && filled(t)) t += march;
    else
      while (t > 0.4 && !filled(t)) t -= march;
    if (const Vec3 p = centre + t * reach; is_inside(p, cell, kOwnMargin * solid.diagonal())) result.push_back(p);
  }
  return result;
}

/// The leaf behind a place on a cut, on the half that is not reversed or on the other; -1: none.
int leaf_behind(const Partition& partition, const std::vector<std::vector<Plane>>& cells, int cut, bool is_reversed,
                const Vec3& p) {
  for (std::size_t a = 0; a < cells.size(); ++a) {
    bool is_here = false, is_out = false;
    for (std::size_t s = 0; s < cells[a].size(); ++s) {
      const CutSide& side = partition.leaves[a].sides[s];
      if (side.cut == cut)
        is_here = side.is_reversed == is_reversed;
      else if (cells[a][s].signed_distance(p) > 0)
        is_out = true;
    }
    if (is_here && !is_out) return static_cast<int>(a);
  }
  return -1;
}

/// The sections of a cut: one for every set of leaves that hang together through the rock in its plane.
void add_sections(const Solid& solid, Partition& partition, int cut, double spacing) {
  const Plane& plane = partition.cuts[static_cast<std::size_t>(cut)].plane;
  const std::vector<Plane> cell = partition.planes_of(partition.cuts[static_cast<std::size_t>(cut)].sides);
  std::vector<std::vector<Plane>> cells;
  for (const Leaf& leaf : partition.leaves) cells.push_back(partition.planes_of(leaf.sides));
  const CutGrid grid(solid, plane);
  std::vector<FilledPlace> places;
  std::vector<int> number(kSectionSamples * kSectionSamples, -1);
  Groups groups(partition.leaves.size());
  for (int j = 0; j < kSectionSamples; ++j)
    for (int i = 0; i < kSectionSamples; ++i) {
      const Point2 at = grid.place(i, j);
      const Vec3 p = grid(at);
      if (!is_inside(p, cell, 0) || solid.occupancy(p) < 0.5) continue;
      const FilledPlace place{
          at, {leaf_behind(partition, cells, cut, false, p), leaf_behind(partition, cells, cut, true, p)}};
      if (place.leaf[0] < 0 || place.leaf[1] < 0) continue;
      groups.join(place.leaf[0], place.leaf[1]);
      for (const int neighbour : {i > 0 ? number[static_cast<std::size_t>(j * kSectionSamples + i - 1)] : -1,
                                  j > 0 ? number[static_cast<std::size_t>((j - 1) * kSectionSamples + i)] : -1})
        if (neighbour >= 0) groups.join(place.leaf[0], places[static_cast<std::size_t>(neighbour)].leaf[0]);
      number[static_cast<std::size_t>(j * kSectionSamples + i)] = static_cast<int>(places.size());
      places.push_back(place);
    }
  std::vector<std::vector<Point2>> places_of(partition.leaves.size());
  for (const FilledPlace& place : places)
    places_of[static_cast<std::size_t>(groups.of(place.leaf[0]))].push_back(place.at);
  for (std::size_t g = 0; g < places_of.size(); ++g) {
    if (places_of[g].size() < 3) continue;
    Section section;
    section.cut = cut;
    section.corners = section_corners(solid, grid, places_of[g], cell, spacing);
    std::set<int> leaves, walls;
    for (const FilledPlace& place : places)
      if (groups.of(place.leaf[0]) == static_cast<int>(g)) leaves.insert({place.leaf[0], place.leaf[1]});
    const int own = static_cast<int>(partition.sections.size());
    for (const int leaf : leaves) {
      std::vector<int>& sections = partition.leaves[static_cast<std::size_t>(leaf)].sections;
      walls.insert(sections.begin(), sections.end());
      sections.push_back(own);
    }
    for (const int wall : walls)
      if (partition.sections[static_cast<std::size_t>(wall)].cut != cut) section.walls.push_back(wall);
    partition.sections.push_back(std::move(section));
  }
}

}  // namespace

Partition start_partition(const Solid& solid, const CutTree& tree, int count, int vertices, std::uint64_t seed) {
  Partition partition;
  const std::vector<int> pieces = tree.pieces(count);
  const double spacing = vertex_spacing(solid.volume() / static_cast<double>(pieces.size()), vertices);
  for (std::size_t c = 0; c + 1 < pieces.size(); ++c)
    partition.cuts.push_back({tree.cuts()[c], sides_of(tree.divided_cell(static_cast<int>(c)), tree.cuts())});
  for (const int piece : pieces)
    partition.leaves.push_back({sides_of(tree.piece(piece).cell, tree.cuts()), {}, {}, {}});
  for (std::size_t c = 0; c < partition.cuts.size(); ++c) add_sections(solid, partition, static_cast<int>(c), spacing);
  const std::vector<std::vector<Vec3>> on_cuts = part_points(solid, partition);
  for (std::size_t a = 0; a < pieces.size(); ++a) {
    const Piece& piece = tree.piece(pieces[a]);
    const int own = std::max(4, vertices - static_cast<int>(on_cuts[a].size()));
    FitPlan plan;
    plan.seed = sub_seed(seed, a);
    // The more of them fall near a cut, the more are spread: those are left out.
    for (int spread = own; spread <= 4 * own; spread += std::max(1, own / 8)) {
      plan.vertices = spread;
      std::vector<Vec3> points;
      for (const Vec3& p : start_points(solid, piece.region, piece.cell.planes, plan))
        if (is_inside(p, piece.cell.planes, 0.3 * spacing)) points.push_back(p);
      if (static_cast<int>(points.size()) > own) points.resize(static_cast<std::size_t>(own));
      partition.leaves[a].points = std::move(points);
      if (static_cast<int>(partition.leaves[a].points.size()) == own) break;
    }
    while (static_cast<int>(partition.leaves[a].points.size()) < own)
      partition.leaves[a].points.push_back(piece.region.centroid);  // the fit puts it where rock stands out
  }
  return partition;
}

}  // namespace decomposition
