// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"
#include "decomposition/convex_decomposition.h"

namespace workflows {

struct DecomposeBatchOptions {
  std::string catalog = "the catalogue";  // its name in messages
  std::vector<int> part_counts{1, 2, 4, 8};
  std::vector<int> vertex_caps{32};  // every number of parts at each of these caps
  std::string select;                // catalogue query; empty: every shape
  std::vector<std::string> names;    // of the shapes; empty: those of the query
  // Its parts and vertex_cap are not used; its time budget is for all levels of a shape, in equal shares for the caps.
  decomposition::DecompositionOptions quality;
};

/// One level of one shape, made now or kept from before.
struct DecomposedLevel {
  std::string shape;
  catalog::LevelOfDetail level;
  bool is_new = false;
  double seconds = 0;  // wall time of all new levels of the shape together
};

struct DecomposeBatchResult {
  std::vector<DecomposedLevel> levels;
  struct Failure {
    std::string shape, reason;
    std::optional<catalog::LevelKey> level;  // none: the whole shape
  };
  std::vector<Failure> failures;
};

/// Makes the levels that the selected shapes lack and stores them, one transaction a shape. A level counts as present
/// if tool version, options and the mesh's bytes are the same. A shape that cannot be decomposed is listed and passed
/// over, and so is a level; the shape's other levels are kept. The threads of `quality` go to several shapes at a time,
/// or to the search inside one where there are fewer shapes, a time budget, or meshes so large that two would take much
/// memory; the catalogue's bytes do not depend on their number. `about_to` is called before each shape with work to do,
/// with its name and the number of such shapes. Throws InputError if the query selects nothing.
DecomposeBatchResult decompose_shapes(catalog::ShapeCatalog& shapes, const DecomposeBatchOptions& options,
                                      const std::function<void(const std::string& name, std::size_t of)>& about_to);

/// A table; modes and caps of faces have columns where a level is not volume-true or has such a cap.
std::string batch_text(const DecomposeBatchResult& result);
std::string batch_json(const DecomposeBatchResult& result);
/// "rock: not decomposed: ...", or "rock: 2 parts of 32 vertices: not made: ...".
std::string failure_text(const DecomposeBatchResult::Failure& failure);

}  // namespace workflows
