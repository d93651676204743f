// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "catalog/separate_bodies.h"
#include "catalog/shape_record.h"
#include "catalog/triangle_mesh.h"

namespace decomposition {

using catalog::FitMode;
using catalog::SeparateBodies;

inline constexpr double kLeastEffort = 0.1, kMostEffort = 100;
inline constexpr int kFewestVertices = 8, kMostVertices = 64;               // of a part, that may be asked for
inline constexpr int kFewestFaces = 8, kMostFaces = 2 * kMostVertices - 4;  // triangles of a closed surface

struct DecompositionOptions {
  int parts = 8;        // at most; fewer where more would not help or would make slivers
  int vertex_cap = 32;  // of each part, 8 to 64
  int face_cap = 0;     // of each part, faces in one plane counted as one, 8 to 124; 0: none
  FitMode mode = FitMode::volume_true;
  SeparateBodies bodies = SeparateBodies::join;  // largest: of most volume, with its cavities
  std::uint64_t seed = 1;                        // same mesh, options and seed: same bytes, whatever `threads` is
  double effort = 1;  // scales the number of cuts and fits tried, 0.1 to 100; time grows in proportion
  // CPU time [s] for all levels together: instead of one search of `effort`, whole searches of growing effort, as many
  // as fit into it, at least one, up to the greatest effort, of which each level keeps the best: one that keeps the
  // rules on edges and faces, then the one of least error; so more time never gives a worse level. How many fit depends
  // on the machine. 0: none.
  double time_budget = 0;
  double smallest_thickness = 0.1;  // of a part / thickness of the whole, of several bodies of the thickest
  double smallest_volume = 0.01;    // of a part / volume of the whole, of several bodies of the largest
  int threads = 0;                  // 0: as many as the machine has
};

/// Figures of a level beside its error.
struct LevelFigures {
  // Area on the cuts marked inner but bare, or outer but covered, on both sides / covered area of one side [-].
  double ledge_area = 0;
  double smallest_thickness = 0;  // smallest extent of a part along one of its face normals [m]
  double smallest_volume = 0;     // [m3]
  double shortest_edge = 0;       // of a part / largest distance of two of its vertices
  double narrowest_face = 0;      // width of a face, of a triangle its least height / the same
  int vertices = 0, faces = 0;    // in all
  int outer_faces = 0;
  int most_vertices = 0, most_faces = 0;  // of a part
};

/// Divides the solid into convex parts: a partition by cut planes (binary space partition). All parts are fitted at
/// once: their own vertices, the corners of one convex polygon on every cut, which the parts of both its sides share,
/// and the cut planes move until the symmetric difference to the mesh is least (volume-true: at the mesh's volume).
/// Parts never overlap: every vertex lies exactly on its side of every cut, and faces on a cut carry its plane bit for
/// bit. Sharing leaves no ledges; where a rule has cost one side a corner, LevelFigures::ledge_area says how much.
/// A part has at most `vertex_cap` vertices and, if asked for, `face_cap` faces. No edge is shorter than 1 % and no
/// face narrower than 2 % of the part's size (largest distance of two vertices), but for exact pieces, for faces split
/// along a large ledge, and where a bound (`mode`) leaves no room. No part is thinner or smaller than asked for; where
/// that leaves no room the level has fewer parts.
/// Needles and plates, more than 6 times as long as thick by their second moments, are divided and fitted in the affine
/// frame that makes them about as long as thick (RoundFrame), as well as compact bodies are: there the rules on edges
/// and faces hold; the figures are those of the parts as they are.
/// `enclosing`: every point of the mesh lies in a part, without tolerance (to rounding in hulls of a drawn solid's
/// pieces, whose cuts run along its facets). `inscribed`: no part reaches deeper into the
/// void than 1e-5 of the diagonal. A level under a bound is never farther from the mesh than those of 1, 2, 4, ...
/// parts below it: where more parts would be, it has fewer.
/// A convex mesh within the caps comes back as its own hull, and a solid of few flat facets as the exact convex pieces
/// that the search finds; pieces beside exact ones, and those of shells whose sections are no convex polygons, are
/// fitted one by one, each to its own volume, with their cuts' ledges, and scaled together to the mesh's. The error is
/// measured (measure_error). The mesh must be closed; it may have handles, cavities (hollows closed off from outside,
/// which stay hollow) and several bodies (`bodies`). Bodies apart are divided one by one, as well as each would be
/// alone: all have a part (but those too small for one), further parts go where they gain most; bodies whose parts
/// would meet are divided together. Fewer parts than bodies span some, or are refused where more than a quarter of the
/// volume would be missing. Surfaces that lie wholly in the rock, so that they would count it twice, are left out.
/// Surfaces that cut one another are refused if that puts more than 0.1 % of the volume in doubt. Provenance: `options`
/// holds the options, the LevelFigures and what was found in the mesh as JSON,
/// {"options": {...}, "search": {"seed", "effort"}, "measured": {...}, "mesh": {...}}; the caller fills in the rest.
/// Throws catalog::InputError for a mesh that bounds no solid, for options out of range, where no part keeps the bound,
/// and where the parts miss the mesh: by all its volume, or volume-true by 5 % of it (few parts of thin shells).
catalog::LevelOfDetail decompose(const catalog::TriangleMesh& mesh, const DecompositionOptions& options = {});

/// A level, or why there is none.
struct LevelOutcome {
  catalog::LevelOfDetail level;
  std::string refusal;  // empty: the level is there
};

/// Several levels at once, sharing one search, in the order asked for. `options.parts` is not used. Each level is the
/// same as decompose() would give for it alone (without a time budget); the cuts move from level to level, so levels
/// are not nested. One that cannot be made says why; throws as decompose() for what no number of parts would change.
std::vector<LevelOutcome> decompose_levels(const catalog::TriangleMesh& mesh, const std::vector<int>& part_counts,
                                           const DecompositionOptions& options = {});

/// The same where all are needed: throws InputError where one cannot be made.
std::vector<catalog::LevelOfDetail> decompose_ladder(const catalog::TriangleMesh& mesh,
                                                     const std::vector<int>& part_counts,
                                                     const DecompositionOptions& options = {});

/// Figures of finished parts; ledge_area needs the cuts and stays 0 here, a level's provenance has it.
LevelFigures figures(const std::vector<catalog::ConvexPart>& parts);

/// The options that change the result, as a JSON object; what Provenance::options holds under "options".
std::string options_json(const DecompositionOptions& options);

}  // namespace decomposition
