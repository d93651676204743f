// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "catalog/convex_part.h"
#include "catalog/fit_mode.h"
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

/// Where a shape lies in its source, such as a scan or a tomogram, whose lengths are taken in metres: a point p of the
/// shape is the point origin + (p[0] axes[0] + p[1] axes[1] + p[2] axes[2]) / scale of the source.
struct SourceFrame {
  Matrix3 axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // of the shape, in the frame of the source
  Point origin{};                                   // the shape's, in the frame of the source [m]
  double scale = 1;                                 // length in the catalogue / length in the source
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
  std::optional<SourceFrame> source_frame;  // none where it was not kept
};

/// Distances from points spread over one surface to another, over the bounding-box diagonal of the mesh [-].
struct SurfaceDistance {
  double mean = 0;
  double percentile_95 = 0;  // 95 % of the points are at most this far away
  double largest = 0;        // sampled one-sided Hausdorff distance

  friend bool operator==(const SurfaceDistance&, const SurfaceDistance&) = default;
};

/// Measured error of a level of detail against its mesh. A figure that was not measured is not a number: levels of
/// catalogues of an older schema lack those that came later.
struct DecompositionError {
  double symmetric_difference = 0;  // V(union xor mesh) / V(mesh) [-]
  double method_error = 0;          // standard error of symmetric_difference by the measuring method [-]
  double missing_volume = 0;        // V(mesh minus union) / V(mesh) [-]
  double volume_error = 0;          // (V(union) - V(mesh)) / V(mesh), signed: of the mass at equal density [-]
  double overlap = 0;               // sum of part volumes / V(union) - 1 [-]; 0 for a partition

  SurfaceDistance surface_from_mesh;   // points of the mesh to the union's surface
  SurfaceDistance surface_from_union;  // points of the union's surface to the mesh
  SurfaceDistance surface;             // two-sided: both sets of points together, each of the same weight

  double centre_error = 0;     // distance of the centres of mass / bounding-box diagonal [-]
  double inertia_error = 0;    // |J - J_mesh| / |J_mesh|, Frobenius norms of the inertia tensors about own centres [-]
  double convexity_error = 0;  // V / V_hull of the union less that of the mesh, signed [-]

  friend bool operator==(const DecompositionError&, const DecompositionError&) = default;
};

/// A level has at most so many parts.
inline constexpr int kMostParts = 256;

/// Tells the levels of one shape apart: a level made with the same key takes the place of the one before.
struct LevelKey {
  int parts_asked = 0;  // 1, 2, 4, 8, ...: a level has at most as many parts
  int vertex_cap = 0;   // largest number of vertices a part may have
  int face_cap = 0;     // largest number of faces a part may have; 0: no cap
  FitMode mode = FitMode::volume_true;

  friend bool operator==(const LevelKey&, const LevelKey&) = default;
};

/// "of at most 32 vertices and 24 faces, enclosing"; what is usual (no cap of faces, volume-true) is left out.
inline std::string described_limits(const LevelKey& key) {
  std::string text = "of at most " + std::to_string(key.vertex_cap) + " vertices";
  if (key.face_cap > 0) text += " and " + std::to_string(key.face_cap) + " faces";
  if (key.mode != FitMode::volume_true) text += ", " + mode_name(key.mode);
  return text;
}

/// "8 parts of at most 32 vertices and 24 faces, enclosing"
inline std::string described(const LevelKey& key) {
  return std::to_string(key.parts_asked) + (key.parts_asked == 1 ? " part " : " parts ") + described_limits(key);
}

/// One level of detail of a shape: a partition into convex parts in the frame of ShapeRecord::mesh.
struct LevelOfDetail {
  LevelKey key;
  std::vector<ConvexPart> parts;
  MassProperties mass_properties;  // of the union, in the mesh's frame (centroid need not be exactly 0)
  DecompositionError error;
  Provenance provenance;
};

}  // namespace catalog
