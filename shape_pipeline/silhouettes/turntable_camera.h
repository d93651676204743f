// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// The camera of a turntable. The grain turns about z, which points up; the camera stands on the side of -y, its
/// columns run along x. It looks at a point of the axis, the origin, and the axis is upright in the image (no roll).
/// Pixel coordinates are continuous, (0, 0) at the upper left corner of the image, rows downwards.
struct TurntableCamera {
  bool is_perspective = false;              // else orthographic (telecentric)
  double pixel_size = 0;                    // [m], orthographic
  double focal_length = 0;                  // [pixels], perspective
  std::array<double, 2> principal_point{};  // column, row, perspective
  double distance = 0;                      // from the lens to the origin [m], perspective
  double elevation = 0;                     // of the camera, seen from the origin, above the horizon [rad]
  std::optional<double> axis_column;        // where the axis lies in the image; else estimated from the silhouettes
  bool turns_clockwise = false;             // the grain, seen from above
  std::vector<double> angles;               // of the grain in each view [rad]; empty: equal steps of a whole turn
};

/// Reads turntable.json:
///   {"unit": "mm", "pixel_size": 0.02}                                      orthographic
///   {"unit": "mm", "focal_length": 2400, "principal_point": [640, 512], "distance": 250}   perspective
/// with, if need be, "elevation" [deg], "axis_column" [pixels], "turn": "counterclockwise" or "clockwise" and
/// "angles" [deg]. Throws InputError, the file and key named.
TurntableCamera read_turntable_camera(const std::filesystem::path& path);

/// The angles of `views` views [rad], counterclockwise positive.
std::vector<double> view_angles(const TurntableCamera& camera, std::size_t views);

/// Where a point lies in one view.
struct ImagePoint {
  double column = 0, row = 0;
  double metres_per_pixel = 0;  // there
};

/// The view of the grain turned by `angle` [rad]. `image_height` [pixels]: an orthographic camera has its origin in the
/// middle row, since nothing tells it. The camera must have its axis_column.
class TurntableProjection {
 public:
  TurntableProjection(const TurntableCamera& camera, double angle, int image_height);
  ImagePoint operator()(const catalog::Point& point) const;

 private:
  double cosine_, sine_, cosine_up_, sine_up_;
  double scale_;      // [pixels/m] orthographic; [pixels] perspective
  double distance_;   // [m]; 0: orthographic
  double shift_ = 0;  // of the axis, along x [m], perspective
  double column_, row_;
};

/// Leftmost and rightmost column of a silhouette.
using ColumnExtent = std::array<double, 2>;

struct AxisEstimate {
  double column = 0;
  double scatter = 0;  // root mean square of what the fit leaves [pixels]
};

/// The column of the axis from the extents of the views. The tangents on the left of one view are those on the right of
/// another, so the middles of the extents (of an orthographic camera; of the angles of sight in perspective) have the
/// axis for their mean over a whole turn, and are odd harmonics about it: fitted with the first, and of 8 views or more
/// the third. Exact in perspective where the axis passes through the principal point's column. Throws InputError,
/// calling the views `name`, for fewer than 4 views or a gap above 100 degrees between them.
AxisEstimate estimated_axis(const TurntableCamera& camera, const std::vector<double>& angles,
                            const std::vector<ColumnExtent>& extents, const std::filesystem::path& name);

}  // namespace shape_pipeline
