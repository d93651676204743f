// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/convex_decomposition.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <utility>

#include "catalog/input_error.h"
#include "catalog/mass_properties.h"
#include "decomposition/assembly/body_search.h"
#include "decomposition/decomposition_quality.h"
#include "decomposition/geometry/random.h"
#include "decomposition/solid/solid_surface.h"

namespace decomposition {
namespace {

/// "expected 8 to 64"
std::string range_text(double least, double most) {
  char text[64];
  std::snprintf(text, sizeof text, "expected %g to %g", least, most);
  return text;
}

void check_options(const DecompositionOptions& options, const std::vector<int>& part_counts) {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw catalog::InputError("decomposition option " + what);
  };
  require(!part_counts.empty(), "parts: no level asked for, expected numbers such as 1,2,4,8");
  for (const int count : part_counts)
    require(count >= 1 && count <= catalog::kMostParts,
            "parts: " + std::to_string(count) + ", " + range_text(1, catalog::kMostParts));
  require(options.vertex_cap >= kFewestVertices && options.vertex_cap <= kMostVertices,
          "vertices: " + std::to_string(options.vertex_cap) + ", " + range_text(kFewestVertices, kMostVertices));
  require(
      options.face_cap == 0 || (options.face_cap >= kFewestFaces && options.face_cap <= kMostFaces),
      "faces: " + std::to_string(options.face_cap) + ", " + range_text(kFewestFaces, kMostFaces) + ", or 0 for no cap");
  require(options.time_budget >= 0, "time_budget: expected seconds, or 0 for none");
  require(options.effort >= kLeastEffort && options.effort <= kMostEffort,
          "effort: " + range_text(kLeastEffort, kMostEffort));
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

/// `searched`: the search that found the level, which under a time budget has an effort and a seed of its own.
std::string provenance_json(DecompositionOptions asked, const DecompositionOptions& searched, int parts_asked,
                            const LevelFigures& measured) {
  asked.parts = parts_asked;
  return "{\"options\":" + options_json(asked) + ",\"search\":{\"seed\":" + std::to_string(searched.seed) +
         ",\"effort\":" + number(searched.effort) + "}" +
         ",\"measured\":{\"ledge_area_ratio\":" + number(measured.ledge_area) +
         ",\"smallest_thickness\":" + number(measured.smallest_thickness) +
         ",\"smallest_volume\":" + number(measured.smallest_volume) +
         ",\"shortest_edge_ratio\":" + number(measured.shortest_edge) +
         ",\"narrowest_face_ratio\":" + number(measured.narrowest_face) +
         ",\"vertices\":" + std::to_string(measured.vertices) + ",\"faces\":" + std::to_string(measured.faces) +
         ",\"outer_faces\":" + std::to_string(measured.outer_faces) +
         ",\"most_vertices\":" + std::to_string(measured.most_vertices) +
         ",\"most_faces\":" + std::to_string(measured.most_faces) + "}}";
}

std::string remedy_for_few(int parts, int bodies) {
  if (parts >= bodies)
    return "so few parts cannot stand for it; ask for more parts, thinner or smaller ones, more effort or another seed";
  return "it has " + std::to_string(bodies) + " bodies, which fewer parts cannot stand for; ask for at least " +
         std::to_string(bodies) + " parts, or keep the largest body alone with --bodies largest";
}

/// Parts that stand for nothing of the mesh are no level of detail: few parts of thin shells, say.
void refuse_misfit(const catalog::LevelOfDetail& level, const BodySearch& search) {
  constexpr double kLargestDifference = 1, kLargestVolumeError = 0.05;  // of the mesh's volume
  constexpr double kMostMissing = 0.25;  // where parts would have to span bodies that lie apart
  const bool is_volume_off =
      level.key.mode == FitMode::volume_true && std::abs(level.error.volume_error) > kLargestVolumeError;
  const int parts = level.key.parts_asked;
  const bool loses_bodies = parts < search.heaps() && level.error.missing_volume > kMostMissing;
  if (level.error.symmetric_difference < kLargestDifference && !is_volume_off && !loses_bodies) return;
  char text[256];
  std::snprintf(text, sizeof text, "mesh: its %d %s from it by %.0f %% of its volume, their volume by %.1f %%: ", parts,
                parts == 1 ? "part differs" : "parts differ", 100 * level.error.symmetric_difference,
                100 * level.error.volume_error);
  throw catalog::InputError(text + remedy_for_few(parts, search.bodies()));
}

/// A level as a search finds it, or its refusal.
struct MadeLevel {
  LevelOutcome outcome;
  bool keeps_rules = false;

  bool is_there() const { return outcome.refusal.empty(); }
  bool is_better_than(const MadeLevel& other) const {
    if (is_there() != other.is_there()) return is_there();
    if (keeps_rules != other.keeps_rules) return keeps_rules;
    return outcome.level.error.symmetric_difference < other.outcome.level.error.symmetric_difference;
  }
};

catalog::LevelOfDetail make_level(const ErrorMeasurement& measure, const BodySearch& search, const FoundLevel& found,
                                  int parts_asked, const DecompositionOptions& options,
                                  const DecompositionOptions& asked) {
  if (found.parts.empty())
    throw catalog::InputError("mesh: no convex parts that are " + mode_name(options.mode) + " could be fitted to it; " +
                              (parts_asked < search.bodies() ? remedy_for_few(parts_asked, search.bodies())
                                                             : "ask for more parts, or for thinner or smaller ones"));
  catalog::LevelOfDetail level;
  level.key = {parts_asked, options.vertex_cap, options.face_cap, options.mode};
  catalog::VolumeMoments moments;
  for (const BuiltPart& part : found.parts) {
    moments += catalog::volume_moments(catalog::triangulated(part.part));
    level.parts.push_back(part.part);
  }
  level.mass_properties = catalog::mass_properties(moments);
  level.error = measure(level.parts);
  refuse_misfit(level, search);
  LevelFigures measured = figures(level.parts);
  if (found.coverage.covered_area > 0) measured.ledge_area = found.coverage.ledge_area / found.coverage.covered_area;
  level.provenance.options = provenance_json(asked, options, parts_asked, measured);
  return level;
}

std::vector<MadeLevel> make_levels(const catalog::TriangleMesh& solid, const ErrorMeasurement& measure,
                                   const std::vector<int>& part_counts, const DecompositionOptions& options,
                                   const DecompositionOptions& asked) {
  BodySearch search(solid, options);
  std::vector<MadeLevel> levels;
  for (const int count : part_counts) {
    MadeLevel made;
    const FoundLevel& found = search.find(count);
    try {
      made.outcome.level = make_level(measure, search, found, count, options, asked);
      made.keeps_rules = found.keeps_rules;
    } catch (const catalog::InputError& refusal) {
      made.outcome.refusal = refusal.what();
    }
    levels.push_back(std::move(made));
  }
  return levels;
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The best levels of whole searches, each of twice the effort of the one before, as many as fit into the time.
std::vector<MadeLevel> levels_in_time(const catalog::TriangleMesh& solid, const ErrorMeasurement& measure,
                                      const std::vector<int>& part_counts, const DecompositionOptions& asked) {
  constexpr double kGrowth = 2;
  DecompositionOptions options = asked;
  const double begin = cpu_seconds();
  std::vector<MadeLevel> best;
  options.effort = kLeastEffort;
  for (std::uint64_t round = 0;; ++round) {
    const double round_begin = cpu_seconds();
    options.seed = round == 0 ? asked.seed : sub_seed(asked.seed, round);
    std::vector<MadeLevel> made = make_levels(solid, measure, part_counts, options, asked);
    if (best.empty()) best = made;
    for (std::size_t k = 0; k < made.size(); ++k)
      if (made[k].is_better_than(best[k])) best[k] = std::move(made[k]);
    const double next_effort = std::fmin(kGrowth * options.effort, kMostEffort);
    const double now = cpu_seconds(), next = next_effort / options.effort * (now - round_begin);
    if (now - begin + next > asked.time_budget || options.effort == kMostEffort) break;
    options.effort = next_effort;
  }
  return best;
}

/// Adds the shortest edge and the narrowest face of a part to the figures.
void measure_slivers(const catalog::ConvexPart& part, LevelFigures& result) {
  double size = 0;
  for (const catalog::Point& p : part.vertices)
    for (const catalog::Point& q : part.vertices) size = std::fmax(size, norm(to_vec3(p) - to_vec3(q)));
  for (const catalog::ConvexFace& face : part.faces) {
    const auto at = [&](std::size_t k) {
      return to_vec3(part.vertices[static_cast<std::size_t>(face.vertices[k % face.vertices.size()])]);
    };
    double width = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < face.vertices.size(); ++k) {
      const Vec3 edge = at(k + 1) - at(k);
      result.shortest_edge = std::fmin(result.shortest_edge, norm(edge) / size);
      double reach = 0;
      for (std::size_t v = 0; v < face.vertices.size(); ++v)
        reach = std::fmax(reach, norm(cross(edge, at(v) - at(k))) / norm(edge));
      width = std::fmin(width, reach);
    }
    result.narrowest_face = std::fmin(result.narrowest_face, width / size);
  }
}

}  // namespace

std::vector<LevelOutcome> decompose_levels(const catalog::TriangleMesh& mesh, const std::vector<int>& part_counts,
                                           const DecompositionOptions& options) {
  check_options(options, part_counts);
  const SolidSurface surface = solid_surface(mesh, options.bodies);
  const catalog::TriangleMesh& solid = surface.cleaned ? *surface.cleaned : mesh;
  const ErrorMeasurement measure(solid);
  std::vector<LevelOutcome> outcomes;
  for (MadeLevel& made : options.time_budget > 0 ? levels_in_time(solid, measure, part_counts, options)
                                                 : make_levels(solid, measure, part_counts, options, options)) {
    if (made.is_there()) {
      made.outcome.level.provenance.options.back() = ',';
      made.outcome.level.provenance.options += "\"mesh\":" + surface.notes.json() + "}";
    }
    outcomes.push_back(std::move(made.outcome));
  }
  return outcomes;
}

std::vector<catalog::LevelOfDetail> decompose_ladder(const catalog::TriangleMesh& mesh,
                                                     const std::vector<int>& part_counts,
                                                     const DecompositionOptions& options) {
  std::vector<catalog::LevelOfDetail> levels;
  for (LevelOutcome& outcome : decompose_levels(mesh, part_counts, options)) {
    if (!outcome.refusal.empty()) throw catalog::InputError(outcome.refusal);
    levels.push_back(std::move(outcome.level));
  }
  return levels;
}

catalog::LevelOfDetail decompose(const catalog::TriangleMesh& mesh, const DecompositionOptions& options) {
  return decompose_ladder(mesh, {options.parts}, options).front();
}

LevelFigures figures(const std::vector<catalog::ConvexPart>& parts) {
  LevelFigures result;
  result.smallest_thickness = result.smallest_volume = std::numeric_limits<double>::infinity();
  result.shortest_edge = result.narrowest_face = std::numeric_limits<double>::infinity();
  for (const catalog::ConvexPart& part : parts) {
    result.vertices += static_cast<int>(part.vertex_count());
    result.faces += static_cast<int>(part.face_count());
    result.most_vertices = std::max(result.most_vertices, static_cast<int>(part.vertex_count()));
    result.most_faces = std::max(result.most_faces, static_cast<int>(part.face_count()));
    measure_slivers(part, result);
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
         ",\"face_cap\":" + std::to_string(options.face_cap) + ",\"mode\":\"" + mode_name(options.mode) +
         "\",\"bodies\":\"" + separate_bodies_name(options.bodies) + "\",\"seed\":" + std::to_string(options.seed) +
         ",\"effort\":" + number(options.effort) + ",\"time_budget\":" + number(options.time_budget) +
         ",\"smallest_thickness\":" + number(options.smallest_thickness) +
         ",\"smallest_volume\":" + number(options.smallest_volume) + "}";
}

}  // namespace decomposition
