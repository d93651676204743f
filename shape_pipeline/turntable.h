// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "catalog/shape_record.h"
#include "shape_pipeline/colour_image.h"
#include "shape_pipeline/mesh_remeshing.h"
#include "shape_pipeline/micrographs/raster.h"
#include "shape_pipeline/silhouettes/turntable_camera.h"

namespace shape_pipeline {

struct TurntableOptions {
  double pixel_size = 0;  // [m] of an orthographic camera; 0: turntable.json says
  int cells = 160;        // of the grid, along the hull's longest side
  int genus = 0;          // handles of the grain
  RemeshingOptions remeshing;
};

/// Images of one grain turned in front of a camera. An image that cannot be used keeps its angle and has a reason.
struct TurntableViews {
  std::vector<std::string> names;
  std::vector<GreyImage> images;
  std::vector<std::string> refusals;  // empty where the image can be used
  TurntableCamera camera;
};

/// The images of a folder (PNG, JPEG, BMP, TIFF) in natural order, then turntable.json where there is one. Throws
/// InputError for a path that is no folder and for a folder without images.
std::vector<std::filesystem::path> turntable_sources(const std::filesystem::path& folder);

/// The images of a folder with the camera of its turntable.json, or an orthographic one of the options' pixel size.
/// Throws InputError, the file named, where neither is given or both differ, and for a list of angles of another
/// length.
TurntableViews read_turntable(const std::filesystem::path& folder, const TurntableOptions& options);

/// A grain from silhouettes: its visual hull, which is never smaller than the grain where the views are right: hollows
/// that no silhouette shows are filled, and views about one axis leave its two ends round or flat by guess. Name and
/// provenance are left to the caller. Checks beside those of every solid: "turntable_views" (those left out, by name),
/// "turntable_axis", "turntable_resolution", "silhouettes_explained", "visual_hull". Throws InputError, calling the
/// views `name`, for fewer than 3 that can be used and for views that do not bound a grain or fit together nowhere.
catalog::ShapeRecord digitize_turntable(TurntableViews views, const std::string& name, const TurntableOptions& options);

/// One view with the outline of a hull over it.
struct ViewPicture {
  std::string name;
  ColourImage image;
};

/// At most `count` of the views that can be used, spread over the turn, each at most `largest_side` pixels a side, with
/// the outline that the hull (in the frame of the turntable) has in it, red. `axis_column` as "turntable_axis" found
/// it.
std::vector<ViewPicture> hull_pictures(TurntableViews views, double axis_column, const catalog::TriangleMesh& hull,
                                       std::size_t count, int largest_side);

}  // namespace shape_pipeline
