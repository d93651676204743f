// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of what is seen by a camera: micrographs and turntables.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "workflows/batch_refusal.h"
#include "workflows/digitize_report/digitize_report.h"
#include "workflows/digitize_report/grain_pages.h"
#include "workflows/text_format.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;
using postprocess::LinePlot;
using postprocess::PageTable;
using postprocess::short_number;
using shape_pipeline::ColourImage;
using shape_pipeline::Micrograph;

constexpr int kOverlaySide = 1400, kSmallOverlaySide = 700, kViewSide = 240;  // [pixels]
constexpr std::size_t kFewImages = 4, kMostImages = 40;                       // large so far; pictured at all
constexpr std::size_t kViews = 6;

/// The values of one descriptor over all whole grains, ascending; those that are no numbers left out.
std::vector<double> sorted_values(const Micrograph& micrograph, const std::string& name) {
  std::vector<double> values;
  for (const shape_pipeline::MicrographGrain& grain : micrograph.grains) {
    const double value = shape_pipeline::descriptor_value(grain.descriptors, name);
    if (std::isfinite(value)) values.push_back(value);
  }
  std::sort(values.begin(), values.end());
  return values;
}

/// Of ascending values; between two of them linear.
double percentile(const std::vector<double>& values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (place - static_cast<double>(low)) * (values[high] - values[low]);
}

PageTable count_table(const Micrograph& micrograph) {
  return {"Grains",
          {"", "count"},
          {{"whole, outlined in green", std::to_string(micrograph.grains.size())},
           {"cut by the border, outlined in orange, no figures", std::to_string(micrograph.at_border.size())},
           {"specks below the least diameter", std::to_string(micrograph.specks)},
           {"threads and films", std::to_string(micrograph.films)}}};
}

PageTable figure_table(const Micrograph& micrograph) {
  PageTable table{"Figures of the whole grains",
                  {"descriptor", "unit", "10 %", "median", "90 %", "mean", "standard deviation"},
                  {}};
  for (const shape_pipeline::OutlineDescriptor& descriptor : micrograph.grains.front().descriptors) {
    const std::vector<double> values = sorted_values(micrograph, descriptor.name);
    if (values.empty()) continue;
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double square = 0;
    for (const double value : values) square += (value - mean) * (value - mean);
    std::vector<std::string> row{descriptor.name, descriptor.unit};
    for (const double value : {percentile(values, 0.1), percentile(values, 0.5), percentile(values, 0.9), mean,
                               count > 1 ? std::sqrt(square / (count - 1)) : 0.0})
      row.push_back(short_number(value, 5));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Share of the grains at or below each value.
LinePlot distribution(const Micrograph& micrograph, const char* name, const char* title, const char* label,
                      double factor) {
  LinePlot plot;
  plot.title = title;
  plot.x_label = label;
  plot.y_label = "share of the grains [%]";
  plot.y_range = {0, 100};
  plot.height = 260;
  postprocess::Curve curve;
  const std::vector<double> values = sorted_values(micrograph, name);
  for (std::size_t k = 0; k < values.size(); ++k) {
    curve.x.insert(curve.x.end(), 2, factor * values[k]);
    for (const std::size_t below : {k, k + 1})
      curve.y.push_back(100 * static_cast<double>(below) / static_cast<double>(values.size()));
  }
  plot.curves.push_back(std::move(curve));
  return plot;
}

postprocess::SourceEntry micrograph_entry(const fs::path& image, const Micrograph& micrograph, int side) {
  postprocess::SourceEntry source;
  source.name = image.filename().string();
  if (side > 0)
    source.pictures.push_back(
        page_picture(overlay(image, micrograph, side),
                     formatted("outlines over the image: %d x %d pixels of ", micrograph.width, micrograph.height) +
                         length_text(micrograph.pixel_size)));
  else
    source.notes.push_back(formatted("Pictures of the first %zu images only.", kMostImages));
  source.tables = {count_table(micrograph), figure_table(micrograph)};
  source.plots = {
      distribution(micrograph, "equivalent_diameter_area", "Size", "diameter of equal area [um]", 1e6),
      distribution(micrograph, "ellipse_ratio_minor_over_major_iso", "Aspect ratio",
                   "minor / major axis of the ellipse [-]", 1),
      distribution(micrograph, "circularity_4pi_area_over_perimeter2_imagej", "Circularity", "4 pi A / P2 [-]", 1),
      distribution(micrograph, "roundness_wadell_zheng_hryciw", "Roundness (Wadell)", "roundness [-]", 1)};
  return source;
}

}  // namespace

postprocess::DigitizingReport report_of(const MicrographBatch& batch) {
  GrainPages pages(batch.options().catalog_path, batch.outcomes());
  std::vector<postprocess::SourceEntry> sources;
  const int side = batch.micrographs().size() <= kFewImages ? kOverlaySide : kSmallOverlaySide;
  for (const ReadMicrograph& read : batch.micrographs())
    sources.push_back(micrograph_entry(read.image, read.micrograph, sources.size() < kMostImages ? side : 0));
  for (GrainPages::Grain& grain : pages.grains()) {
    if (!grain.is_drawn) continue;
    if (grain.has_shape()) {
      GrainPages::add_result(grain);
      grain.entry.notes.push_back(
          "A solid made so that silhouettes like it match the outlines: no single grain of the image, so there is no "
          "deviation.");
      continue;
    }
    const fs::path& image = grain.outcome->scan;
    const std::string reason = refusal_of(image.string(), [&] {
      GrainPages::add_input(grain, shape_pipeline::overlay(image, {}, kOverlaySide), "input");
    });
    if (!reason.empty() && reason != grain.entry.refusal)
      grain.entry.notes.push_back("Its source cannot be drawn: " + reason);
  }
  return pages.finished(std::move(sources));
}

postprocess::DigitizingReport report_of(const TurntableBatch& batch) {
  GrainPages pages(batch.options().catalog_path, batch.outcomes());
  for (GrainPages::Grain& grain : pages.grains()) {
    if (!grain.is_drawn) continue;
    const catalog::ShapeRecord& shape = grain.entry.shape;
    catalog::TriangleMesh hull;  // in the frame of the turntable; empty where there is none
    double axis = 0;
    if (grain.has_shape()) {
      GrainPages::add_result(grain);
      for (const catalog::Check& check : shape.checks)
        if (check.name == "turntable_axis") axis = check.figure;
      if (shape.source_frame)
        hull = {shape_pipeline::in_source_frame(*shape.source_frame, shape.mesh.vertices), shape.mesh.faces};
      else
        grain.entry.notes.push_back("Its place in the views was not kept (it was stored by an older version).");
    }
    const std::string reason = refusal_of(grain.outcome->scan.string(), [&] {
      std::vector<ColourImage> views;
      for (auto& picture : hull_pictures(shape_pipeline::read_turntable(grain.outcome->scan, batch.pipeline_options()),
                                         axis, hull, kViews, kViewSide))
        views.push_back(std::move(picture.image));
      if (!views.empty())
        GrainPages::add_input(grain, side_by_side(views, 4),
                              formatted("input: %zu views over the turn", views.size()) +
                                  (hull.faces.empty() ? "" : ", with the outline of the hull in red"));
    });
    if (!reason.empty() && reason != grain.entry.refusal)
      grain.entry.notes.push_back("Its views cannot be drawn: " + reason);
  }
  return pages.finished({});
}

}  // namespace workflows
