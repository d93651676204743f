// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/core/quaternion.h"
#include "dem_gpu/shapes/shape_columns.h"

namespace dem_gpu {

/// x_target = scale * rotation * x_source + translation, between the unscaled body frames of two bodies. Contact
/// geometry is computed there, so its accuracy does not depend on where the bodies are in the world.
struct FrameChange {
  Mat3 rotation;
  Vec3 translation;
  Real scale = 1;

  TALUS_HD Vec3 point(const Vec3& x) const { return scale * (rotation * x) + translation; }
  TALUS_HD Vec3 direction(const Vec3& x) const { return rotation * x; }
};

/// Pose of a body: x_world = scale * rotation * x + position.
struct Pose {
  Mat3 rotation;
  Vec3 position;
  Real scale = 1;
};

/// From b's unscaled body frame to a's.
TALUS_HD inline FrameChange frame_change(const Pose& a, const Pose& b) {
  return {transpose_times(a.rotation, b.rotation), (1 / a.scale) * transpose_times(a.rotation, b.position - a.position),
          b.scale / a.scale};
}

/// A body's depth field in one part: the least of the depths below planes and of the terms' greatest depths.
struct DepthField {
  const LocalHalfSpace* planes;
  int plane_count;
  const DepthTerm* terms;
  int term_count;
  const LocalHalfSpace* term_planes;
};

/// One convex part with pointers into the shape columns.
struct PartView {
  const PartRange& range;
  const LocalVec3* vertices;
  const LocalHalfSpace* planes;
  const FaceCorners* faces;
  const std::uint8_t* corners;
  const FacePiece* face_pieces;
  const VertexBlock* vertex_blocks;  // of this part
  DepthField depth;
};

TALUS_HD inline PartView part_view(const ShapeView& shapes, int part) {
  const PartRange& range = shapes.parts[part];
  return {range,
          shapes.vertices + range.first_vertex,
          shapes.planes + range.first_face,
          shapes.faces + range.first_face,
          shapes.corners,
          shapes.face_pieces,
          shapes.vertex_blocks + range.first_vertex_block,
          {shapes.depth_planes + range.first_depth_plane, range.depth_plane_count,
           shapes.depth_terms + range.first_depth_term, range.depth_term_count, shapes.term_planes}};
}

}  // namespace dem_gpu
