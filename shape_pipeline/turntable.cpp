// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/turntable.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <utility>

#include "catalog/input_error.h"
#include "shape_pipeline/digitization.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/micrographs/image_file.h"
#include "shape_pipeline/reading/folder_files.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/shape_descriptors.h"
#include "shape_pipeline/silhouettes/mesh_silhouette.h"
#include "shape_pipeline/silhouettes/silhouette_image.h"
#include "shape_pipeline/silhouettes/visual_hull.h"
#include "shape_pipeline/solid_checks.h"

namespace shape_pipeline {
namespace {

namespace fs = std::filesystem;

constexpr char kSidecarName[] = "turntable.json";
constexpr std::size_t kLeastViews = 3;
constexpr double kLeastExplained = 0.98;       // of a silhouette's area, by the hull's
constexpr double kVoxelCountTolerance = 0.05;  // of the volume
constexpr double kSamePixel = 1e-6;            // largest relative difference of two statements of the pixel size

std::vector<fs::path> image_files(const fs::path& folder) {
  if (!fs::is_directory(folder)) refuse_file(folder, "", "is no folder", "name the folder of the turntable's images");
  std::vector<fs::path> images = files_in_natural_order(folder, {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"});
  if (images.empty())
    refuse_file(folder, "", "no images (PNG, JPEG, BMP, TIFF) in this folder", "put one a view there");
  return images;
}

TurntableCamera camera_of(const fs::path& folder, const TurntableOptions& options) {
  const fs::path sidecar = folder / kSidecarName;
  if (!fs::exists(sidecar)) {
    if (options.pixel_size <= 0)
      refuse_file(folder, "", "the length scale is not known",
                  "add --pixel (of an orthographic camera) or write turntable.json there");
    TurntableCamera camera;
    camera.pixel_size = options.pixel_size;
    return camera;
  }
  TurntableCamera camera = read_turntable_camera(sidecar);
  if (options.pixel_size > 0 && !(std::abs(camera.pixel_size / options.pixel_size - 1) < kSamePixel))
    refuse_file(sidecar, "pixel_size", "states another pixel size than --pixel, or a perspective camera",
                "leave one of them out");
  return camera;
}

/// The views that most images agree with in size; the others are refused.
void refuse_odd_sizes(TurntableViews& views) {
  std::map<std::pair<int, int>, int> sizes;
  for (std::size_t k = 0; k < views.images.size(); ++k)
    if (views.refusals[k].empty()) ++sizes[{views.images[k].width, views.images[k].height}];
  const auto usual =
      std::max_element(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  for (std::size_t k = 0; k < views.images.size(); ++k) {
    const GreyImage& image = views.images[k];
    if (!views.refusals[k].empty() || std::pair(image.width, image.height) == usual->first) continue;
    views.refusals[k] = views.names[k] + ": is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                        " pixels, the other views are " + std::to_string(usual->first.first) + " x " +
                        std::to_string(usual->first.second) + "; take all with one camera";
  }
}

/// What of the views could be used.
struct SeenViews {
  std::vector<SilhouetteImage> silhouettes;
  std::vector<double> angles;  // [rad]
  std::vector<std::string> refusals;
  int height = 0;
};

SeenViews seen_views(TurntableViews& views, const std::string& name) {
  refuse_odd_sizes(views);
  const std::vector<double> angles = view_angles(views.camera, views.names.size());
  SeenViews seen;
  for (std::size_t k = 0; k < views.names.size(); ++k) {
    std::string reason = views.refusals[k];
    try {
      if (reason.empty()) {
        seen.silhouettes.push_back(silhouette_of(views.images[k], views.names[k]));
        seen.angles.push_back(angles[k]);
        seen.height = views.images[k].height;
      }
    } catch (const catalog::InputError& error) {
      reason = error.what();
    }
    views.images[k] = {};
    if (!reason.empty()) seen.refusals.push_back(reason);
  }
  if (seen.silhouettes.size() >= kLeastViews) return seen;
  refuse_file(name, "",
              std::to_string(seen.silhouettes.size()) + " views can be used, at least 3 are needed" +
                  (seen.refusals.empty() ? "" : " (" + seen.refusals.front() + ")"),
              "take more views about the grain");
}

catalog::Check views_check(const SeenViews& seen) {
  std::string detail = "views left out";
  for (const std::string& refusal : seen.refusals) detail += "; " + refusal;
  return {"turntable_views", seen.refusals.empty(), static_cast<double>(seen.refusals.size()), detail};
}

catalog::Check settle_axis(TurntableCamera& camera, const SeenViews& seen, const std::string& name) {
  if (camera.axis_column) return {"turntable_axis", true, *camera.axis_column, "column of the axis, as stated"};
  std::vector<ColumnExtent> extents;
  for (const SilhouetteImage& silhouette : seen.silhouettes) extents.push_back({silhouette.left, silhouette.right});
  const AxisEstimate axis = estimated_axis(camera, seen.angles, extents, name);
  camera.axis_column = axis.column;
  char text[120];
  std::snprintf(text, sizeof text,
                "column of the axis, estimated from the silhouettes; what the fit leaves: %.2f pixels", axis.scatter);
  return {"turntable_axis", true, axis.column, text};
}

/// Least share of a view's silhouette that the hull covers: 1 if all views fit together.
catalog::Check explained_check(const catalog::TriangleMesh& hull, const std::vector<HullView>& views) {
  double least = 1;
  for (const HullView& view : views) {
    const DistanceImage& image = view.silhouette.distance;
    const Raster<float> covered = mesh_coverage(hull, view.projection, image.width, image.height);
    const double area = std::accumulate(covered.values.begin(), covered.values.end(), 0.0);
    least = std::min(least, area / view.silhouette.area);
  }
  return {"silhouettes_explained", least >= kLeastExplained, least,
          "least share of a silhouette that the hull covers, expected 0.98: else axis, angles or scale are wrong"};
}

VisualHull hull_of(const std::vector<HullView>& views, const std::string& name, int cells) {
  std::optional<VisualHull> hull = visual_hull(views, cells);
  if (!hull) refuse_file(name, "", "the views do not bound the grain", "take views all about it");
  if (hull->mesh.faces.empty())
    refuse_file(name, "", "the silhouettes have no point in common",
                "correct the axis, the angles or the order of views");
  return *std::move(hull);
}

/// The view, shrunk, with the rim of what the hull covers in red.
ColourImage outlined_view(const GreyImage& view, const Raster<float>& covered, double scale) {
  constexpr Colour kOutline{230, 40, 40};
  ColourImage picture = picture_of(view, {}, scale);
  const auto is_inside = [&](int x, int y) {
    const int column = static_cast<int>((x + 0.5) / scale), row = static_cast<int>((y + 0.5) / scale);
    return covered.has(column, row) && covered(column, row) > 0.5F;
  };
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (is_inside(x, y) &&
          !(is_inside(x - 1, y) && is_inside(x + 1, y) && is_inside(x, y - 1) && is_inside(x, y + 1)))
        picture(x, y) = kOutline;
  return picture;
}

}  // namespace

std::vector<fs::path> turntable_sources(const fs::path& folder) {
  std::vector<fs::path> files = image_files(folder);
  if (fs::exists(folder / kSidecarName)) files.push_back(folder / kSidecarName);
  return files;
}

TurntableViews read_turntable(const fs::path& folder, const TurntableOptions& options) {
  const std::vector<fs::path> files = image_files(folder);
  TurntableViews views;
  views.camera = camera_of(folder, options);
  if (!views.camera.angles.empty() && views.camera.angles.size() != files.size())
    refuse_file(folder / kSidecarName, "angles",
                "states " + std::to_string(views.camera.angles.size()) + " angles, the folder has " +
                    std::to_string(files.size()) + " images",
                "state one a view, in natural order of the file names");
  for (const fs::path& file : files) {
    views.names.push_back(file.string());
    views.images.emplace_back();
    views.refusals.emplace_back();
    try {
      views.images.back() = read_image(file);
    } catch (const catalog::InputError& error) {
      views.refusals.back() = error.what();
    }
  }
  return views;
}

catalog::ShapeRecord digitize_turntable(TurntableViews views, const std::string& name,
                                        const TurntableOptions& options) {
  SeenViews seen = seen_views(views, name);
  const catalog::Check axis = settle_axis(views.camera, seen, name);
  const auto widest = std::max_element(
      seen.silhouettes.begin(), seen.silhouettes.end(),
      [](const SilhouetteImage& a, const SilhouetteImage& b) { return a.right - a.left < b.right - b.left; });
  const double width = widest->right - widest->left;
  std::vector<HullView> hull_views;
  for (std::size_t k = 0; k < seen.silhouettes.size(); ++k)
    hull_views.push_back({std::move(seen.silhouettes[k]), {views.camera, seen.angles[k], seen.height}});
  const VisualHull hull = hull_of(hull_views, name, options.cells);
  const LargestSurface largest = largest_surface(hull.mesh);
  SolidExpectation expectation;
  expectation.genus = options.genus;
  expectation.second_volume = hull.counted_volume;
  expectation.second_volume_tolerance = kVoxelCountTolerance;
  std::vector<catalog::Check> checks = solid_checks(largest.mesh, expectation);
  checks.push_back(views_check(seen));
  checks.push_back(axis);
  checks.push_back({"turntable_resolution", true, width, "pixels across the widest silhouette"});
  checks.push_back(explained_check(largest.mesh, hull_views));
  checks.push_back({"visual_hull", true, static_cast<double>(hull_views.size()),
                    "views that bound the volume from above: hollows that no silhouette shows are filled, the ends of "
                    "the axis are seen from the side alone"});
  const RemeshedMesh remeshed = remesh(largest.mesh, options.remeshing);
  catalog::ShapeRecord shape = in_principal_frame(remeshed.mesh);
  shape.checks = std::move(checks);
  shape.checks.insert(shape.checks.end(), remeshed.checks.begin(), remeshed.checks.end());
  shape.descriptors = shape_descriptors(shape.mesh);
  return shape;
}

std::vector<ViewPicture> hull_pictures(TurntableViews views, double axis_column, const catalog::TriangleMesh& hull,
                                       std::size_t count, int largest_side) {
  refuse_odd_sizes(views);
  views.camera.axis_column = axis_column;
  const std::vector<double> angles = view_angles(views.camera, views.names.size());
  std::vector<std::size_t> usable;
  for (std::size_t k = 0; k < views.names.size(); ++k)
    if (views.refusals[k].empty()) usable.push_back(k);
  count = std::min(count, usable.size());
  std::vector<ViewPicture> pictures;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = usable[i * usable.size() / count];
    const GreyImage& view = views.images[k];
    const Raster<float> covered = mesh_coverage(hull, {views.camera, angles[k], view.height}, view.width, view.height);
    const double scale = std::min(1.0, static_cast<double>(largest_side) / std::max(view.width, view.height));
    pictures.push_back({fs::path(views.names[k]).filename().string(), outlined_view(view, covered, scale)});
  }
  return pictures;
}

}  // namespace shape_pipeline
