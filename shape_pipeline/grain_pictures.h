// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "catalog/shape_record.h"
#include "shape_pipeline/colour_image.h"

namespace shape_pipeline {

/// What a picture of a grain shows: a ball seen from two opposite sides, without perspective, so that pictures of one
/// view can be laid over one another.
struct GrainView {
  catalog::Point centre{};
  double radius = 0;  // [m]
  int side = 320;     // of each of the two views [pixels]
};

/// The view that holds all points, or `share` of them where some may be strays.
GrainView view_of(const std::vector<catalog::Point>& points, int side, double share = 1);

/// Drawn without a display by a depth buffer: the same pixels on any machine. Faces in a grain's colour; those seen
/// from behind, through holes or because they are turned inwards, orange.
ColourImage drawn_surface(const catalog::TriangleMesh& mesh, const GrainView& view);

/// Points as dots, the far ones paler.
ColourImage drawn_points(const std::vector<catalog::Point>& points, const GrainView& view);

/// A closed surface with a value at each vertex in the colours of deviation_colour(value / range); grey where the value
/// is not a number.
ColourImage drawn_map(const catalog::TriangleMesh& mesh, const std::vector<double>& values, double range,
                      const GrainView& view);

/// From blue (-1 and below) over white (0) to red (1 and above).
Colour deviation_colour(double share);

/// The points of a source in the frame of a shape.
std::vector<catalog::Point> in_shape_frame(const catalog::SourceFrame& frame, std::vector<catalog::Point> points);

/// The points of a shape in the frame of its source.
std::vector<catalog::Point> in_source_frame(const catalog::SourceFrame& frame, std::vector<catalog::Point> points);

/// How far a surface lies from what it was made from.
struct DeviationMap {
  std::vector<double> values;    // of each vertex [m], positive outside its source; not a number where none is near
  catalog::SurfaceDistance all;  // without sign, of the vertices that have a value [m]
  double share_without = 0;      // of the vertices that have none
};

/// Each vertex has the distance of the source's point nearest to it from the surface, along the line to the surface;
/// none where that point is farther than four times the spacing of the points: gaps that were spanned.
DeviationMap deviation_from_points(const catalog::TriangleMesh& result, const std::vector<catalog::Point>& points);

/// The same from a mesh of any kind, torn or not, by points spread over its faces.
DeviationMap deviation_from_mesh(const catalog::TriangleMesh& result, const catalog::TriangleMesh& source);

/// Fills in mean, 95 %, largest and the share without a value.
DeviationMap with_statistics(std::vector<double> values);

}  // namespace shape_pipeline
