// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dem_gpu/core/device_vector.h"
#include "dem_gpu/core/lanes.h"
#include "dem_gpu/core/vec3.h"
#include "dem_gpu/scene.h"

namespace dem_gpu {

/// Half-space boundary: inside where dot(normal, x) <= offset.
template <class Scalar>
struct BasicHalfSpace {
  Vector3<Scalar> normal;
  Scalar offset = 0;

  template <class Wide>
  requires(sizeof(Wide) > sizeof(Scalar)) TALUS_HD operator BasicHalfSpace<Wide>() const { return {normal, offset}; }
};
using HalfSpace = BasicHalfSpace<Real>;
using LocalHalfSpace = BasicHalfSpace<LocalReal>;

template <class Scalar>
TALUS_HD inline Scalar depth_below(const BasicHalfSpace<Scalar>& plane,
                                   const std::type_identity_t<Vector3<Scalar>>& x) {
  return plane.offset - dot(plane.normal, x);
}

TALUS_HD inline const LocalHalfSpace& rounded(const LocalHalfSpace& plane) { return plane; }
template <class Wide>
requires(sizeof(Wide) > sizeof(LocalReal)) TALUS_HD inline LocalHalfSpace rounded(const BasicHalfSpace<Wide>& plane) {
  return {rounded(plane.normal), static_cast<LocalReal>(plane.offset)};
}

struct PartRange {
  int first_vertex = 0, vertex_count = 0;
  int first_vertex_block = 0;          // of (vertex_count + 7) / 8
  int first_face = 0, face_count = 0;  // outer faces first
  int outer_face_count = 0;
  int first_depth_plane = 0, depth_plane_count = 0;
  int first_depth_term = 0, depth_term_count = 0;
  Vec3 centre;      // of the bounding sphere, body frame [m]
  Real radius = 0;  // of the bounding sphere [m]
};

struct FaceCorners {
  int first = 0;  // into corners
  int count = 0;
  std::uint64_t vertices = 0;  // the same corners as a set: bit v for vertex v of the part
  int first_piece = 0;         // into face_pieces
  int piece_count = 0;
  int plane = 0;  // first face of the part in the same plane: a flat side may be several faces
};
static_assert(kMaxPartVertices <= 64);

/// A face, or a convex piece of one with more than kLanes corners: lanes beyond the corners repeat the first.
struct FacePiece {
  LaneOrder corner;  // vertices of the part
  int count = 0;     // of corners
};

/// Eight vertices of a part, one array a coordinate; those beyond the last one repeat it.
struct VertexBlock {
  LocalReal x[kLanes], y[kLanes], z[kLanes];  // [m]
};

/// Term of a depth field: the greatest of the depths below a few planes.
struct DepthTerm {
  int first = 0, count = 0;  // into term_planes
};

struct ShapeRange {
  int first_part = 0, part_count = 0;  // 0 parts: a sphere
  Real sphere_radius = 0;              // [m]
  Real bounding_radius = 0;            // about the centre of mass [m]
  Real volume = 0;                     // [m3]
  Real equivalent_diameter = 0;        // of the sphere of equal volume [m]
  Vec3 inertia;                        // principal, density 1 [m5]
};

/// Constant during a run, parts in the precision of contact geometry. All at scale 1 in the body frame. Walls that are
/// volume objects stand after the scene's shapes.
struct ShapeColumns {
  DeviceVector<ShapeRange> shapes;      // n_shapes
  DeviceVector<PartRange> parts;        // n_parts
  DeviceVector<LocalVec3> vertices;     // n_vertices [m]
  DeviceVector<LocalHalfSpace> planes;  // n_faces
  DeviceVector<FaceCorners> faces;      // n_faces
  DeviceVector<std::uint8_t> corners;   // vertex of the part, per corner of a face
  DeviceVector<FacePiece> face_pieces;
  DeviceVector<VertexBlock> vertex_blocks;  // the vertices again, for work on eight at a time
  // The body's depth field in a part: the least of the depths below depth_planes and of the depth terms.
  DeviceVector<LocalHalfSpace> depth_planes;
  DeviceVector<DepthTerm> depth_terms;
  DeviceVector<LocalHalfSpace> term_planes;
};

/// The same on the host, for checks and tests.
struct HostShapeColumns {
  std::vector<ShapeRange> shapes;
  std::vector<PartRange> parts;
  std::vector<LocalVec3> vertices;
  std::vector<LocalHalfSpace> planes;
  std::vector<FaceCorners> faces;
  std::vector<std::uint8_t> corners;
  std::vector<FacePiece> face_pieces;
  std::vector<VertexBlock> vertex_blocks;
  std::vector<LocalHalfSpace> depth_planes;
  std::vector<DepthTerm> depth_terms;
  std::vector<LocalHalfSpace> term_planes;
};

struct ShapeView {
  const ShapeRange* shapes;
  const PartRange* parts;
  const LocalVec3* vertices;
  const LocalHalfSpace* planes;
  const FaceCorners* faces;
  const std::uint8_t* corners;
  const FacePiece* face_pieces;
  const VertexBlock* vertex_blocks;
  const LocalHalfSpace* depth_planes;
  const DepthTerm* depth_terms;
  const LocalHalfSpace* term_planes;
};

/// `depth_cap` in equivalent diameters: a constant term of every depth field; nullopt: no depth fields.
HostShapeColumns make_host_shape_columns(const std::vector<Shape>& shapes, std::optional<Real> depth_cap);
ShapeColumns make_shape_columns(const std::vector<Shape>& shapes, std::optional<Real> depth_cap);
ShapeColumns to_device(const HostShapeColumns& host);
HostShapeColumns to_host(const ShapeColumns& columns);
/// The shapes of these rows alone, in this order.
HostShapeColumns chosen_shapes(const HostShapeColumns& columns, const std::vector<int>& rows);
ShapeView view(const ShapeColumns& columns);
ShapeView view(const HostShapeColumns& columns);

}  // namespace dem_gpu
