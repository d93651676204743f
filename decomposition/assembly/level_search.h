// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "decomposition/assembly/part_builder.h"
#include "decomposition/convex_decomposition.h"
#include "decomposition/fit/partition_finish.h"
#include "decomposition/search/cut_tree.h"

namespace decomposition {

/// Finished parts with their faces marked.
struct FoundLevel {
  std::vector<BuiltPart> parts;
  double ledge_area = 0;  // see LevelFigures
};

/// The search on one mesh, kept while several levels are made: cut trees of several seeds, of which the best go on at
/// certain numbers of parts; joint fits of all parts from these, and a long one from the best. A level does not depend
/// on which others were made before it.
class LevelSearch {
 public:
  LevelSearch(const catalog::TriangleMesh& mesh, const DecompositionOptions& options);

  /// At most `parts_asked` parts; no parts if none could be fitted.
  FoundLevel find(int parts_asked);

 private:
  /// A tree at every number of parts it has had, as grown, and where its cuts were moved then, as moved.
  struct TreeStages {
    std::map<int, CutTree> grown, moved;
    std::map<int, double> misfit;  // where it was moved: of the joint fit then [m3]
  };
  /// Parts fitted jointly for comparison.
  struct Start {
    Partition partition;
    double misfit = 0;
    std::size_t tree = 0;
  };

  int threads() const;
  double thickness_of_whole() const;
  SearchPlan search_plan(std::size_t tree) const;
  JointPlan joint_plan() const;
  PartRules rules() const;

  const CutTree& stage(std::size_t tree, int count);
  const CutTree& polished(std::size_t tree, int count);
  void move_cuts(TreeStages& stages, int count) const;
  void plant_trees(int count);
  std::vector<std::size_t> racing_trees(int count);
  const std::vector<Start>& starts(int count);
  std::vector<Start> starts_from(std::size_t tree, int count);

  /// The finished parts of a start, and their misfit; no parts if one collapsed.
  struct Finish {
    std::vector<BuiltPart> parts;
    double misfit = 0;
    bool keeps_rules = false;  // a bound may leave no room for that
  };
  Finish finished(Partition partition) const;
  std::vector<BuiltPart> built(const Partition& partition) const;
  FoundLevel found_jointly(int count);
  bool fits_better_apart(const CutTree& tree, int count);
  FoundLevel found_apart(const CutTree& tree, int count) const;
  std::vector<BuiltPart> all_alone(const CutTree& tree, const std::vector<int>& pieces, double volume_factor) const;
  std::optional<BuiltPart> fitted_alone(const Piece& piece, int number, double volume_factor) const;
  bool is_acceptable(const std::vector<BuiltPart>& parts) const;

  DecompositionOptions options_;
  Solid solid_, coarse_;
  SearchPlan plan_;
  double columns_volume_ = 0;  // of the solid, by its columns
  double started_ = 0;         // CPU time [s]
  std::vector<TreeStages> trees_;
  std::map<int, std::vector<Start>> starts_;
};

}  // namespace decomposition
