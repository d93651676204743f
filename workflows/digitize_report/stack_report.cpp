// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "shape_pipeline/stack_pictures.h"
#include "workflows/batch_refusal.h"
#include "workflows/digitize_report/digitize_report.h"
#include "workflows/digitize_report/grain_pages.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;
using shape_pipeline::ColouredGrain;
using shape_pipeline::ColourImage;
using shape_pipeline::StackPictures;

constexpr int kSliceSide = 520;   // [pixels]
constexpr double kWindow = 1.25;  // half width of a grain's section / its radius
constexpr const char* kDirections[] = {"x (to the right y, down z)", "y (to the right x, down z)",
                                       "z (to the right x, down y)"};

double check_figure(const catalog::ShapeRecord& shape, const std::string& name) {
  const auto found = std::find_if(shape.checks.begin(), shape.checks.end(),
                                  [&](const catalog::Check& check) { return check.name == name; });
  return found == shape.checks.end() ? 0 : found->figure;
}

/// The grain in three sections of the stack, its surface, and how far that lies from where the grey passes the
/// threshold.
void draw(GrainPages::Grain& grain, const StackPictures& stack, const ColouredGrain& coloured) {
  const catalog::ShapeRecord& shape = grain.entry.shape;
  std::vector<ColourImage> sections;
  for (const int axis : {0, 1, 2})
    sections.push_back(stack.section(
        {axis, shape.source_frame->origin, kWindow * grain.view.radius / shape.source_frame->scale, grain.view.side},
        {coloured}));
  GrainPages::add_input(grain, side_by_side(sections, 4),
                        "input: sections through its centre across x, y and z, with the result's outline");
  shape_pipeline::DeviationMap map = stack.deviation(coloured.mesh, check_figure(shape, "stack_threshold"));
  GrainPages::add_map(grain, map);
}

postprocess::SourceEntry stack_entry(const fs::path& path, const StackPictures& stack,
                                     const std::vector<ColouredGrain>& grains) {
  postprocess::SourceEntry source;
  source.name = (path.has_filename() ? path : path.parent_path()).filename().string();
  for (const int axis : {0, 1, 2})
    source.pictures.push_back(
        page_picture(stack.section({axis, stack.middle(), 0, kSliceSide}, grains),
                     std::string("middle slice across ") + kDirections[axis] + ", grains in the colours of the table"));
  source.notes.push_back(
      "What is bright without a colour is no grain of the catalogue: cut by the border, a speck, or refused.");
  return source;
}

}  // namespace

postprocess::DigitizingReport report_of(const StackBatch& batch) {
  GrainPages pages(batch.options().catalog_path, batch.outcomes());
  std::vector<postprocess::SourceEntry> sources;
  for (const fs::path& path : batch.options().inputs) {
    std::vector<ColouredGrain> coloured;
    std::vector<std::pair<GrainPages::Grain*, std::size_t>> drawn;
    for (GrainPages::Grain& grain : pages.grains()) {
      if (grain.outcome->scan != path || !grain.has_shape()) continue;
      if (!grain.entry.shape.source_frame) {
        grain.entry.notes.push_back(
            "Its place in the stack was not kept (it was stored by an older version). Digitise it into a new "
            "catalogue.");
        continue;
      }
      ColouredGrain one{grain.entry.shape.mesh, shape_pipeline::numbered_colour(coloured.size())};
      one.mesh.vertices =
          shape_pipeline::in_source_frame(*grain.entry.shape.source_frame, std::move(one.mesh.vertices));
      grain.entry.colour = one.colour;
      if (grain.is_drawn) drawn.push_back({&grain, coloured.size()});
      coloured.push_back(std::move(one));
    }
    for (const auto& [grain, number] : drawn) GrainPages::add_result(*grain);
    const std::string reason = refusal_of(path.string(), [&] {
      const StackPictures stack(path, batch.pipeline_options());
      sources.push_back(stack_entry(path, stack, coloured));
      for (const auto& [grain, number] : drawn) draw(*grain, stack, coloured[number]);
    });
    if (reason.empty()) continue;
    postprocess::SourceEntry source;
    source.name = path.filename().string();
    source.notes.push_back("No slices: " + reason);
    sources.push_back(std::move(source));
  }
  return pages.finished(std::move(sources));
}

}  // namespace workflows
