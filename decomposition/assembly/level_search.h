// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
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

/// The search on one mesh, kept while several levels are made: cut trees of several seeds, a joint fit of all parts
/// from each for comparison, and a long one from the best. A level does not depend on which others were made before it.
class LevelSearch {
 public:
  LevelSearch(const catalog::TriangleMesh& mesh, const DecompositionOptions& options);

  /// At most `parts_asked` parts; no parts if none could be fitted.
  FoundLevel find(int parts_asked);

 private:
  /// One tree at every number of parts it has had: from time to time its cuts are moved, so that it cannot be asked for
  /// its past.
  using TreeStages = std::map<int, CutTree>;

  struct Start {
    Partition partition;
    double misfit = 0;
    std::size_t tree = 0;
  };

  int threads() const;
  double thickness_of_whole() const;
  SearchPlan search_plan(std::uint64_t tree) const;
  JointPlan joint_plan() const;
  PartRules rules() const;
  const CutTree& stage(std::size_t tree, int count);
  bool has_time_for_another(std::size_t trees, double seconds_each) const;
  const std::vector<Start>& starts(int count);
  std::optional<Start> start_from(std::size_t tree, int count, int variant);
  void add_starts(std::size_t tree, int count, std::vector<Start>& result);
  std::vector<BuiltPart> fitted_jointly(Partition partition) const;
  FoundLevel found_jointly(int count);
  FoundLevel found_apart(const CutTree& tree, int count) const;
  std::optional<BuiltPart> fitted_alone(const Piece& piece, int number) const;
  bool is_acceptable(const std::vector<BuiltPart>& parts) const;

  DecompositionOptions options_;
  Solid solid_, coarse_;
  SearchPlan plan_;
  double columns_volume_ = 0;  // of the solid, by its columns
  double started_ = 0;         // CPU time [s]
  std::vector<std::unique_ptr<TreeStages>> trees_;
  std::map<int, std::vector<Start>> starts_;
};

}  // namespace decomposition
