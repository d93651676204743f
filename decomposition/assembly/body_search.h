// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <vector>

#include "catalog/triangle_mesh.h"
#include "decomposition/assembly/level_search.h"
#include "decomposition/convex_decomposition.h"

namespace decomposition {

/// The search on a mesh of one body or several. A single body is one LevelSearch. Bodies that lie apart are searched
/// one by one, each at its own scale, wherever they are: every body gets a part, further parts go where they gain most.
/// Bodies whose parts would meet (interlocked ones, or near ones in few parts) are searched together. So are all bodies
/// at fewer parts than bodies, where parts have to span some. A body too small or too thin for a part of its own goes
/// with the nearest that is not.
class BodySearch {
 public:
  BodySearch(const catalog::TriangleMesh& mesh, const DecompositionOptions& options);

  /// As LevelSearch::find().
  const FoundLevel& find(int parts_asked);
  /// That may have parts of their own.
  int bodies() const { return static_cast<int>(bodies_.size()); }
  /// Of these, those whose boxes meet counted as one.
  int heaps() const;

 private:
  struct Body {
    catalog::TriangleMesh mesh;
    double volume = 0, thickness = 0;  // [m3], [m]
  };
  using Group = std::vector<int>;  // numbers of bodies that are searched together, ascending

  void find_bodies();
  Group all_bodies() const;
  LevelSearch& search_of(const Group& group);
  std::vector<int> shares(const std::vector<Group>& groups, int parts);
  static bool merge_where_parts_meet(const std::vector<const FoundLevel*>& levels, std::vector<Group>& groups);
  FoundLevel searched(int parts_asked);

  const catalog::TriangleMesh& mesh_;
  DecompositionOptions options_;
  double volume_;                      // of all bodies together [m3]
  double largest_ = 0, thickest_ = 0;  // volume and thickness of the body with most of it [m3], [m]
  std::vector<Body> bodies_;
  std::map<Group, LevelSearch> searches_;
  std::map<int, FoundLevel> levels_;
};

}  // namespace decomposition
