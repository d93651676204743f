// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/corner_measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double kCellsPerScale = 4;  // the midpoint rule's error is then below 1e-3 of f
constexpr int kSamples = 4000;        // points of the surface at which f is taken
constexpr double kReach = 6;          // in scales: the Gaussian's mass beyond is below 1e-7

/// A piece of the surface: its middle and normal times area.
struct Patch {
  Point middle{}, area{};
};

/// The flux of a Gaussian's field: with y the way from its centre in scales, div(y g(y^2)) is the Gaussian.
class GaussianField {
 public:
  GaussianField() {
    for (int k = 0; k <= kEntries; ++k) values_[k] = exact(kReach * kReach * k / kEntries);
  }

  double operator()(double squared) const {
    const double place = squared * (kEntries / (kReach * kReach));
    if (place >= kEntries) return 1 / (4 * pi * squared * std::sqrt(squared));
    const auto k = static_cast<int>(place);
    return values_[k] + (place - k) * (values_[k + 1] - values_[k]);
  }

 private:
  static constexpr int kEntries = 8192;

  static double exact(double squared) {
    const double s = std::sqrt(squared);
    if (s < 1e-2) return std::sqrt(2 / pi) / (4 * pi) * (1.0 / 3 - squared / 10);  // series of what follows
    const double mass = std::erf(s / std::numbers::sqrt2) - std::sqrt(2 / pi) * s * std::exp(-squared / 2);
    return mass / (4 * pi * squared * s);
  }

  std::array<double, kEntries + 1> values_;
};

double flux(std::span<const Patch> patches, const Point& x, double scale) {
  static const GaussianField field;
  double sum = 0;
  const double per_squared = 1 / (scale * scale);
  for (const Patch& patch : patches) {
    const Point way = subtract(patch.middle, x);
    sum += dot(way, patch.area) * field(dot(way, way) * per_squared);
  }
  return sum * per_squared / scale;
}

/// Halves the longest side until all are below `longest`.
void add_pieces(const Point& a, const Point& b, const Point& c, double longest, std::vector<Patch>& pieces) {
  const double ab = distance(a, b), bc = distance(b, c), ca = distance(c, a);
  if (std::max({ab, bc, ca}) <= longest) {
    pieces.push_back({scaled(add(a, add(b, c)), 1.0 / 3), scaled(cross(subtract(b, a), subtract(c, a)), 0.5)});
    return;
  }
  const auto halve = [&](const Point& from, const Point& to, const Point& apex) {
    const Point middle = scaled(add(from, to), 0.5);
    add_pieces(apex, from, middle, longest, pieces);
    add_pieces(apex, middle, to, longest, pieces);
  };
  if (ab >= bc && ab >= ca)
    halve(a, b, c);
  else if (bc >= ca)
    halve(b, c, a);
  else
    halve(c, a, b);
}

std::vector<Patch> surface_pieces(const catalog::TriangleMesh& mesh, double longest) {
  std::vector<Patch> pieces;
  for (const auto& [a, b, c] : mesh.faces)
    add_pieces(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], longest, pieces);
  return pieces;
}

using CellKey = std::array<long, 3>;

CellKey cell_of(const Point& p, double side) {
  CellKey key;
  for (int i = 0; i < 3; ++i) key[i] = std::lround(std::floor(p[i] / side));
  return key;
}

using Cells = std::map<CellKey, std::vector<Patch>>;

Cells cells_of(const std::vector<Patch>& pieces, double side) {
  Cells cells;
  for (const Patch& piece : pieces) cells[cell_of(piece.middle, side)].push_back(piece);
  return cells;
}

Patch merged(const std::vector<Patch>& pieces) {
  Patch sum;
  double weight = 0;
  for (const Patch& piece : pieces) {
    const double area = norm(piece.area);
    sum.middle = add(sum.middle, scaled(piece.middle, area));
    sum.area = add(sum.area, piece.area);
    weight += area;
  }
  sum.middle = weight > 0 ? scaled(sum.middle, 1 / weight) : pieces.front().middle;
  return sum;
}

/// The surface as seen from its points: in detail nearby, in blocks farther away, where only solid angles count.
class SeenSurface {
 public:
  SeenSurface(const Cells& cells, double scale) : scale_(scale) {
    std::vector<Patch> merged_cells;
    for (const auto& [key, pieces] : cells) merged_cells.push_back(merged(pieces));
    for (auto& [key, patches] : cells_of(merged_cells, kBlock * scale)) {
      const Patch whole = merged(patches);
      blocks_.push_back({whole, std::move(patches)});
    }
  }

  double inside_share(const Point& x) const {
    double sum = 0;
    for (const Block& block : blocks_) {
      const bool is_far = distance(block.whole.middle, x) > kFar * scale_;
      sum += is_far ? flux(std::span(&block.whole, 1), x, scale_) : flux(block.patches, x, scale_);
    }
    return sum;
  }

 private:
  static constexpr double kBlock = 2, kFar = 8;  // side and distance of blocks, in scales

  struct Block {
    Patch whole;
    std::vector<Patch> patches;
  };
  std::vector<Block> blocks_;
  double scale_;
};

/// The radius below R whose sphere shows `share`.
double equivalent_radius(double share, double inscribed_radius, double scale) {
  double low = 0, high = inscribed_radius;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = (low + high) / 2;
    (inside_share_on_sphere(middle, scale) < share ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

double inside_share_on_sphere(double radius, double scale) {
  if (!(radius > 0)) return 0;
  const double a = radius / scale;
  return std::erf(std::numbers::sqrt2 * a) / 2 + std::expm1(-2 * a * a) / (std::sqrt(2 * pi) * a);
}

double inside_share(const catalog::TriangleMesh& mesh, const catalog::Point& x, double scale) {
  return flux(surface_pieces(mesh, scale / kCellsPerScale), x, scale);
}

std::optional<CornerMeasure> corner_measure(const catalog::TriangleMesh& mesh, double inscribed_radius) {
  CornerMeasure result;
  result.scale = kCornerScale * inscribed_radius;
  const double side = result.scale / kCellsPerScale, area = surface_area(mesh);
  if (!(area < kMostCornerCells * side * side)) return std::nullopt;
  const Cells cells = cells_of(surface_pieces(mesh, side), side);
  const SeenSurface surface(cells, result.scale);

  const double flattest = inside_share_on_sphere(inscribed_radius, result.scale);
  double passed = 0;
  int taken = 0, corners = 0;
  double excess = 0;
  // Evenly by area in the order of the cells, which lie beside each other.
  for (const auto& [key, pieces] : cells)
    for (const Patch& piece : pieces)
      for (passed += norm(piece.area); passed * kSamples > (taken + 0.5) * area && taken < kSamples; ++taken) {
        const double share = surface.inside_share(piece.middle);
        if (share >= flattest) continue;
        ++corners;
        excess += 1 - equivalent_radius(share, inscribed_radius, result.scale) / inscribed_radius;
      }
  result.area_share = static_cast<double>(corners) / taken;
  result.angularity = excess / taken;
  result.roundness = corners > 0 ? 1 - excess / corners : 1;
  return result;
}

}  // namespace shape_pipeline
