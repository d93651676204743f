// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/convex_decomposition.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <thread>
#include <utility>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "decomposition/assembly/face_kinds.h"
#include "decomposition/assembly/part_builder.h"
#include "decomposition/decomposition_quality.h"
#include "decomposition/fit/part_finish.h"
#include "decomposition/geometry/parallel_for.h"
#include "decomposition/search/cut_tree.h"
#include "decomposition/solid/solid_check.h"

namespace decomposition {
namespace {

constexpr double kFieldCells = 2e6;  // a rock of 30,000 faces gets cells about as wide as its triangles
constexpr int kFitSteps = 500;       // of the final fits
constexpr double kFitTries = 3;      // at effort 1
constexpr double kExactSnap = 1e-9;  // of the size: exact pieces touch their cut planes already

void check_options(const DecompositionOptions& options, const std::vector<int>& part_counts) {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw catalog::InputError("decomposition option " + what);
  };
  require(!part_counts.empty(), "parts: no level asked for, expected numbers such as 1,2,4,8");
  for (const int count : part_counts)
    require(count >= 1 && count <= 256, "parts: " + std::to_string(count) + ", expected 1 to 256");
  require(options.vertex_cap >= 8 && options.vertex_cap <= 64,
          "vertices: " + std::to_string(options.vertex_cap) + ", expected 8 to 64");
  require(options.effort >= 0.1 && options.effort <= 100, "effort: expected 0.1 to 100");
  require(options.smallest_thickness >= 0 && options.smallest_thickness < 1, "smallest_thickness: expected 0 to 1");
  require(options.smallest_volume >= 0 && options.smallest_volume < 1, "smallest_volume: expected 0 to 1");
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

double extent_along(const catalog::FacePlane& plane, const catalog::ConvexPart& part) {
  double deepest = 0;
  for (const catalog::Point& p : part.vertices)
    deepest = std::fmax(deepest, plane.offset - dot(to_vec3(plane.normal), to_vec3(p)));
  return deepest;
}

/// The search on one mesh and everything derived from it, kept while several levels are made.
class Decomposer {
 public:
  Decomposer(const catalog::TriangleMesh& mesh, const DecompositionOptions& options)
      : mesh_(mesh), options_(options), solid_(mesh, kFieldCells), tree_(solid_, search_plan()) {}

  catalog::LevelOfDetail level(int parts_asked) {
    int count = parts_asked;
    tree_.grow(count);
    std::vector<BuiltPart> built = build(count);
    while (count > 1 && !is_acceptable(built)) built = build(--count);
    if (built.empty())
      throw catalog::InputError("mesh: no convex part could be fitted to it; check that it is a solid");
    catalog::LevelOfDetail level;
    level.parts_asked = parts_asked;
    level.vertex_cap = options_.vertex_cap;
    const CutCoverage coverage = mark_faces(built, tree_.cuts(), options_.vertex_cap);
    catalog::VolumeMoments moments;
    for (BuiltPart& part : built) {
      moments += catalog::volume_moments(catalog::triangulated(part.part));
      level.parts.push_back(std::move(part.part));
    }
    level.mass_properties = catalog::mass_properties(moments);
    level.error = measure_error(mesh_, level.parts);
    LevelFigures measured = figures(level.parts);
    if (coverage.covered_area > 0) measured.ledge_area = coverage.ledge_area / coverage.covered_area;
    level.provenance.options = provenance_json(parts_asked, measured);
    return level;
  }

 private:
  SearchPlan search_plan() const {
    SearchPlan plan;
    plan.directions = std::max(4, static_cast<int>(std::lround(40 * options_.effort)));
    plan.refits = std::max(2, static_cast<int>(std::lround(8 * options_.effort)));
    plan.vertex_cap = options_.vertex_cap;
    plan.seed = options_.seed;
    plan.threads = threads();
    plan.smallest_volume = options_.smallest_volume * solid_.volume();
    plan.smallest_thickness = options_.smallest_thickness * thickness_of_whole();
    return plan;
  }

  int threads() const {
    return options_.threads > 0 ? options_.threads
                                : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  }

  /// Smallest extent of the mesh over spread directions and the box's axes.
  double thickness_of_whole() const {
    double thickness = std::numeric_limits<double>::infinity();
    constexpr int kDirections = 200;
    for (int d = 0; d < kDirections + 3; ++d) {
      const Vec3 axis{d == kDirections ? 1.0 : 0.0, d == kDirections + 1 ? 1.0 : 0.0, d == kDirections + 2 ? 1.0 : 0.0};
      const Vec3 direction = d < kDirections ? spread_direction(d, 2 * kDirections) : axis;
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Vec3& p : solid_.vertices()) {
        low = std::fmin(low, dot(direction, p));
        high = std::fmax(high, dot(direction, p));
      }
      thickness = std::fmin(thickness, high - low);
    }
    return thickness;
  }

  std::optional<BuiltPart> finished(int piece_number) const {
    const Piece& piece = tree_.piece(piece_number);
    if (piece.is_exact) return build_part(piece.fit.points, piece.cell, kExactSnap * solid_.diagonal());
    FitPlan plan;
    plan.vertices = options_.vertex_cap;
    plan.steps = kFitSteps;
    plan.volume = piece.region.volume * volume_scale();
    plan.seed = sub_seed(options_.seed, 1000003ull + static_cast<std::uint64_t>(piece_number));
    const int tries = std::max(1, static_cast<int>(std::lround(kFitTries * options_.effort)));
    const PartFit fit = finish_part(solid_, piece.cell.planes, piece.region, plan, tries);
    if (!fit.is_valid()) return std::nullopt;
    return build_part(fit.points, piece.cell, kSnapShare * bounding_box(fit.points).diagonal());
  }

  /// Exact volume over the columns' volume: the pieces' targets then add up to the mesh's volume.
  double volume_scale() const { return solid_.volume() / columns_volume_; }

  std::vector<BuiltPart> build(int count) {
    const std::vector<int> pieces = tree_.pieces(count);
    std::vector<int> missing;
    for (const int piece : pieces)
      if (!finished_.contains(piece)) missing.push_back(piece);
    std::vector<std::optional<BuiltPart>> made(missing.size());
    parallel_for(static_cast<int>(missing.size()), threads(),
                 [&](int i) { made[static_cast<std::size_t>(i)] = finished(missing[static_cast<std::size_t>(i)]); });
    for (std::size_t i = 0; i < missing.size(); ++i) finished_[missing[i]] = std::move(made[i]);
    std::vector<BuiltPart> parts;
    for (const int piece : pieces) {
      if (!finished_.at(piece)) return {};
      parts.push_back(*finished_.at(piece));
    }
    return parts;
  }

  bool is_acceptable(const std::vector<BuiltPart>& built) const {
    return !built.empty() && std::all_of(built.begin(), built.end(), [&](const BuiltPart& part) {
      const LevelFigures figure = figures({part.part});
      return figure.smallest_thickness >= tree_.plan().smallest_thickness &&
             figure.smallest_volume >= tree_.plan().smallest_volume && figure.vertices <= options_.vertex_cap;
    });
  }

  std::string provenance_json(int parts_asked, const LevelFigures& measured) const {
    DecompositionOptions options = options_;
    options.parts = parts_asked;
    return "{\"options\":" + options_json(options) +
           ",\"measured\":{\"ledge_area_ratio\":" + number(measured.ledge_area) +
           ",\"smallest_thickness\":" + number(measured.smallest_thickness) +
           ",\"smallest_volume\":" + number(measured.smallest_volume) +
           ",\"vertices\":" + std::to_string(measured.vertices) + ",\"faces\":" + std::to_string(measured.faces) +
           ",\"outer_faces\":" + std::to_string(measured.outer_faces) + "}}";
  }

  const catalog::TriangleMesh& mesh_;
  DecompositionOptions options_;
  Solid solid_;
  double columns_volume_ = solid_.volume_inside({});
  CutTree tree_;
  std::map<int, std::optional<BuiltPart>> finished_;
};

}  // namespace

std::vector<catalog::LevelOfDetail> decompose_ladder(const catalog::TriangleMesh& mesh,
                                                     const std::vector<int>& part_counts,
                                                     const DecompositionOptions& options) {
  check_options(options, part_counts);
  check_closed_solid(mesh);
  Decomposer decomposer(mesh, options);
  std::vector<catalog::LevelOfDetail> levels;
  for (const int count : part_counts) levels.push_back(decomposer.level(count));
  return levels;
}

catalog::LevelOfDetail decompose(const catalog::TriangleMesh& mesh, const DecompositionOptions& options) {
  return decompose_ladder(mesh, {options.parts}, options).front();
}

LevelFigures figures(const std::vector<catalog::ConvexPart>& parts) {
  LevelFigures result;
  result.smallest_thickness = result.smallest_volume = std::numeric_limits<double>::infinity();
  for (const catalog::ConvexPart& part : parts) {
    result.vertices += static_cast<int>(part.vertex_count());
    result.faces += static_cast<int>(part.face_count());
    for (const catalog::ConvexFace& face : part.faces) {
      result.outer_faces += face.kind == catalog::FaceKind::outer;
      result.smallest_thickness = std::fmin(result.smallest_thickness, extent_along(face.plane, part));
    }
    result.smallest_volume =
        std::fmin(result.smallest_volume, catalog::volume_moments(catalog::triangulated(part)).volume);
  }
  return result;
}

std::string options_json(const DecompositionOptions& options) {
  return "{\"parts\":" + std::to_string(options.parts) + ",\"vertex_cap\":" + std::to_string(options.vertex_cap) +
         ",\"seed\":" + std::to_string(options.seed) + ",\"effort\":" + number(options.effort) +
         ",\"smallest_thickness\":" + number(options.smallest_thickness) +
         ",\"smallest_volume\":" + number(options.smallest_volume) + "}";
}

}  // namespace decomposition
