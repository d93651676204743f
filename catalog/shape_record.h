// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "catalog/convex_part.h"
#include "catalog/mass_properties.h"
#include "catalog/triangle_mesh.h"

namespace catalog {

/// Where a stored thing came from; enough to make it again.
struct Provenance {
  std::string source_file;    // base name of the input as given
  std::string source_sha256;  // of the input's bytes; of the stored mesh's bytes for levels of detail
  std::string tool_version;   // e.g. "talus 0.1.0"
  std::string options;        // JSON object of every option that changes the result
};

/// One check made on the way, with its figure: "closed", "euler_number", "volume_second_method", ...
struct Check {
  std::string name;
  bool passed = false;
  double figure = 0;   // what was measured
  std::string detail;  // one line: what was expected, unit of the figure
};

/// A digitised particle: watertight mesh in metres, centroid at the origin, principal axes along x, y, z
/// (ascending moment of inertia, so the longest direction lies along x).
struct ShapeRecord {
  std::string name;  // unique in a catalogue
  TriangleMesh mesh;
  MassProperties mass_properties;
  std::map<std::string, double> descriptors;  // key names the formula: "sphericity_wadell", "flatness_kong_fonseca"
  Provenance provenance;
  std::vector<Check> checks;
};

/// Measured error of a level of detail against its mesh.
struct DecompositionError {
  double symmetric_difference = 0;  // V(union xor mesh) / V(mesh) [-]
  double missing_volume = 0;        // V(mesh minus union) / V(mesh) [-]
  double volume_error = 0;          // (V(union) - V(mesh)) / V(mesh), signed [-]
  double surface_mean = 0;          // two-sided mean surface distance / bounding-box diagonal [-]
  double surface_max = 0;           // two-sided largest (sampled Hausdorff) / bounding-box diagonal [-]
  double overlap = 0;               // sum of part volumes / V(union) - 1 [-]; 0 for a partition
  double method_error = 0;          // standard error of symmetric_difference by the measuring method [-]
};

/// One level of detail of a shape: a partition into convex parts in the frame of ShapeRecord::mesh.
struct LevelOfDetail {
  int parts_asked = 0;  // 1, 2, 4, 8, ...: parts.size() is at most this
  int vertex_cap = 0;   // largest number of vertices a part may have
  std::vector<ConvexPart> parts;
  MassProperties mass_properties;  // of the union, in the mesh's frame (centroid need not be exactly 0)
  DecompositionError error;
  Provenance provenance;
};

}  // namespace catalog
