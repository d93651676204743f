// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/bench/decomposition/ladder_runs.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "workflows/bench/cpu_clock.h"

namespace workflows {
namespace {

// Products of doubles are exact in quadruple precision.
__extension__ typedef __float128 Quad;

/// Whether every corner lies on the plane or on the side that its `sign` says.
bool is_on_side(const catalog::ConvexPart& part, const catalog::FacePlane& plane, int sign) {
  return std::all_of(part.vertices.begin(), part.vertices.end(), [&](const catalog::Point& p) {
    Quad distance = -static_cast<Quad>(plane.offset);
    for (std::size_t i = 0; i < 3; ++i) distance += static_cast<Quad>(plane.normal[i]) * p[i];
    return sign * distance >= 0;
  });
}

std::vector<double> figures_of(const std::vector<LevelRun>& runs,
                               const std::function<double(const LevelRun&)>& figure) {
  std::vector<double> figures;
  for (const LevelRun& run : runs) figures.push_back(figure(run));
  std::sort(figures.begin(), figures.end());
  return figures;
}

}  // namespace

int overlapping_pairs(const std::vector<catalog::ConvexPart>& parts) {
  std::vector<catalog::FacePlane> planes;
  // Those of the cuts separate most pairs and are tried first.
  for (const catalog::FaceKind kind : {catalog::FaceKind::inner, catalog::FaceKind::outer})
    for (const catalog::ConvexPart& part : parts)
      for (const catalog::ConvexFace& face : part.faces)
        if (face.kind == kind) planes.push_back(face.plane);
  int count = 0;
  for (std::size_t a = 0; a < parts.size(); ++a)
    for (std::size_t b = a + 1; b < parts.size(); ++b)
      count += std::none_of(planes.begin(), planes.end(), [&](const catalog::FacePlane& plane) {
        return (is_on_side(parts[a], plane, -1) && is_on_side(parts[b], plane, 1)) ||
               (is_on_side(parts[a], plane, 1) && is_on_side(parts[b], plane, -1));
      });
  return count;
}

std::vector<LevelRun> run_ladder(const catalog::TriangleMesh& mesh, const std::vector<int>& part_counts,
                                 const decomposition::DecompositionOptions& options) {
  const ProcessClock clock;
  std::vector<catalog::LevelOfDetail> levels = decomposition::decompose_ladder(mesh, part_counts, options);
  const double cpu_seconds = clock.seconds();
  std::vector<LevelRun> runs;
  for (catalog::LevelOfDetail& level : levels) {
    LevelRun run{std::move(level), {}, 0, cpu_seconds};
    run.figures = decomposition::figures(run.level.parts);
    run.figures.ledge_area =
        nlohmann::json::parse(run.level.provenance.options).at("measured").at("ledge_area_ratio").get<double>();
    run.overlapping_pairs = overlapping_pairs(run.level.parts);
    runs.push_back(std::move(run));
  }
  return runs;
}

double median(const std::vector<LevelRun>& runs, const std::function<double(const LevelRun&)>& figure) {
  const std::vector<double> figures = figures_of(runs, figure);
  return figures.at(figures.size() / 2);
}

double least(const std::vector<LevelRun>& runs, const std::function<double(const LevelRun&)>& figure) {
  return figures_of(runs, figure).at(0);
}

double most(const std::vector<LevelRun>& runs, const std::function<double(const LevelRun&)>& figure) {
  return figures_of(runs, figure).at(runs.size() - 1);
}

}  // namespace workflows
