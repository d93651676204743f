// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "decomposition/assembly/face_kinds.h"
#include "decomposition/assembly/part_builder.h"
#include "decomposition/assembly/tree_race.h"
#include "decomposition/convex_decomposition.h"

namespace decomposition {

/// Finished parts with their faces marked.
struct FoundLevel {
  std::vector<BuiltPart> parts;
  CutCoverage coverage;
  bool keeps_rules = true;  // on edges and faces (PartRules), but for what may break them; a bound may leave no room
};

/// The largest of 1, 2, 4, ... below a number of parts above 1.
int fewer_parts(int parts);

/// Of two levels whose parts keep a bound, the first unless it has no parts or leaves more between them and the mesh,
/// which has that volume [m3].
FoundLevel nearer_to_bound(FoundLevel level, const FoundLevel& other, double volume);

/// The search on one mesh, kept while several levels are made: a race of cut trees, a long fit from the best of their
/// starts, and the parts built from it. A level does not depend on which others were made before it.
class LevelSearch {
 public:
  LevelSearch(const catalog::TriangleMesh& mesh, const DecompositionOptions& options);

  /// At most `parts_asked` parts; no parts if none could be fitted. Parts that keep a bound are no farther from the
  /// mesh than those of 1, 2, 4, ... fewer.
  const FoundLevel& find(int parts_asked);
  /// About what so many parts will differ from the mesh by, from a single tree: for sharing parts out [m3].
  double expected_misfit(int parts);

 private:
  /// The finished parts of a start, and their misfit; no parts if one collapsed.
  struct Finish {
    std::vector<BuiltPart> parts;  // in the frame of the mesh
    double misfit = 0;             // in the round frame
    bool keeps_rules = false;      // a bound may leave no room for that
  };
  FoundLevel searched(int parts_asked);
  Finish finished(Partition partition) const;
  bool keep_rules(const std::vector<BuiltPart>& parts) const;
  std::vector<BuiltPart> built(const Partition& partition) const;
  Finish found_jointly(int count);
  bool fits_better_apart(const CutTree& tree, int count);
  std::vector<BuiltPart> found_apart(const CutTree& tree, int count) const;
  std::vector<BuiltPart> found_as_hulls(const CutTree& tree, int count) const;
  std::vector<BuiltPart> all_alone(const CutTree& tree, const std::vector<int>& pieces, double volume_factor) const;
  std::optional<BuiltPart> fitted_alone(const Piece& piece, int number, double volume_factor) const;
  FoundLevel marked(std::vector<BuiltPart> parts, bool is_apart) const;
  bool is_acceptable(const std::vector<BuiltPart>& parts) const;
  std::vector<BuiltPart> with_volume_of_mesh(const std::vector<BuiltPart>& parts) const;
  std::vector<BuiltPart> in_frame_of_mesh(std::vector<BuiltPart> parts) const;

  DecompositionOptions options_;
  RoundFrame frame_;
  TreeRace race_;
  double columns_volume_ = 0;                                        // of the solid, by its columns
  double diagonal_, volume_, smallest_volume_, smallest_thickness_;  // in the frame of the mesh [m], [m3]
  std::map<int, FoundLevel> levels_;
};

}  // namespace decomposition
