// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <functional>
#include <map>

#include "catalog/input_error.h"
#include "shape_pipeline/cloud_file.h"
#include "shape_pipeline/mesh_file.h"
#include "shape_pipeline/scan_file.h"
#include "workflows/batch_refusal.h"
#include "workflows/digitize_report/digitize_report.h"
#include "workflows/digitize_report/grain_pages.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;
using shape_pipeline::DigitizationOptions;
using shape_pipeline::PointCloud;

/// What a grain was made from: points, or a mesh as it stands in its file.
struct ScanInput {
  std::vector<catalog::Point> points;  // of the cloud, or the mesh's vertices [m]
  std::vector<catalog::Triangle> faces;

  bool is_mesh() const { return !faces.empty(); }
  std::string caption() const {
    return is_mesh() ? "input: mesh of " + std::to_string(faces.size()) + " faces, orange where seen from within"
                     : "input: " + std::to_string(points.size()) + " points, the far ones paler";
  }
  shape_pipeline::ColourImage drawn(const shape_pipeline::GrainView& view) const {
    return is_mesh() ? drawn_surface({points, faces}, view) : drawn_points(points, view);
  }
};

constexpr int kSourceSide = 480;         // [pixels]
constexpr double kNeighbourhood = 1.3;   // over the radius of the grain: its points lie within
constexpr double kWithoutStrays = 0.98;  // of the points; strays would leave the rest small

shape_pipeline::GrainView view_of_source(const std::vector<catalog::Point>& points, int side) {
  return shape_pipeline::view_of(points, side, kWithoutStrays);
}

ScanInput scan_input(const fs::path& scan, const DigitizationOptions& options) {
  if (shape_pipeline::scan_kind(scan) == shape_pipeline::ScanKind::mesh) {
    catalog::TriangleMesh mesh = shape_pipeline::read_mesh(scan, options.metres_per_unit);
    return {std::move(mesh.vertices), std::move(mesh.faces)};
  }
  shape_pipeline::CloudReading reading;
  reading.metres_per_unit = options.metres_per_unit;
  reading.drops_nan_points = options.drops_nan_points;
  return {shape_pipeline::read_cloud(scan, reading).cloud.points, {}};
}

/// Input, result and map of a shape; the input alone, in its own frame, of what was rejected.
void draw(GrainPages::Grain& grain, ScanInput input) {
  if (!grain.has_shape()) {
    GrainPages::add_input(grain, input.drawn(view_of_source(input.points, grain.view.side)), input.caption());
    return;
  }
  const catalog::ShapeRecord& shape = grain.entry.shape;
  if (!shape.source_frame) {
    grain.entry.notes.push_back(
        "Its place in its source was not kept (it was stored by an older version): no input, no map. Digitise it into "
        "a new catalogue.");
    return;
  }
  input.points = shape_pipeline::in_shape_frame(*shape.source_frame, std::move(input.points));
  if (!input.is_mesh()) {  // other grains of a plate, and strays, have no part in this one
    const double reach = kNeighbourhood * grain.view.radius;
    std::erase_if(input.points, [&](const catalog::Point& p) {
      return std::hypot(p[0] - grain.view.centre[0], p[1] - grain.view.centre[1], p[2] - grain.view.centre[2]) > reach;
    });
  }
  GrainPages::add_input(grain, input.drawn(grain.view), input.caption());
  GrainPages::add_map(grain, input.is_mesh()
                                 ? shape_pipeline::deviation_from_mesh(shape.mesh, {input.points, input.faces})
                                 : shape_pipeline::deviation_from_points(shape.mesh, input.points));
}

/// `input_of` reads what an outcome was made from.
void draw_all(GrainPages& pages, const std::function<ScanInput(const DigitizedScan&)>& input_of) {
  for (GrainPages::Grain& grain : pages.grains()) {
    if (!grain.is_drawn || grain.outcome->status == "missing") continue;
    if (grain.has_shape()) GrainPages::add_result(grain);
    const std::string reason = refusal_of(grain.outcome->scan.string(), [&] { draw(grain, input_of(*grain.outcome)); });
    if (!reason.empty() && reason != grain.entry.refusal)
      grain.entry.notes.push_back("Its source cannot be drawn: " + reason);
  }
}

}  // namespace

postprocess::DigitizingReport report_of(const DigitizeBatch& batch) {
  GrainPages pages(batch.options().catalog_path, batch.outcomes());
  const DigitizationOptions options = digitization_options(batch.options().settings);
  draw_all(pages, [&](const DigitizedScan& outcome) { return scan_input(outcome.scan, options); });
  return pages.finished({});
}

postprocess::DigitizingReport report_of(const CloudBatch& batch) {
  GrainPages pages(batch.options().catalog_path, batch.outcomes());
  std::map<fs::path, PointCloud> clouds;  // by the first file of each, since several grains may be of one cloud
  draw_all(pages, [&](const DigitizedScan& outcome) {
    if (!clouds.contains(outcome.scan)) clouds[outcome.scan] = batch.source_cloud(outcome.scan);
    return ScanInput{clouds.at(outcome.scan).points, {}};
  });
  std::vector<postprocess::SourceEntry> sources;
  for (const auto& [file, cloud] : clouds) {
    postprocess::SourceEntry source;
    source.name = file.filename().string();
    const ScanInput input{cloud.points, {}};
    source.pictures.push_back(page_picture(
        input.drawn(view_of_source(input.points, kSourceSide)),
        "all that grains were made from, registered and cleared: " + std::to_string(input.points.size()) + " points"));
    sources.push_back(std::move(source));
  }
  return pages.finished(std::move(sources));
}

}  // namespace workflows
