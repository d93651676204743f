// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/digitize_report/grain_pages.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "workflows/text_format.h"

namespace workflows {
namespace {

namespace fs = std::filesystem;
using catalog::ShapeCatalog;
using shape_pipeline::DeviationMap;

// Pictures of a hundred grains take about 15 MB.
constexpr std::size_t kMostDrawn = 100;

/// Of each picture of so many grains [pixels].
int picture_side(std::size_t grains) {
  if (grains <= 12) return 300;
  return grains <= 40 ? 200 : 140;
}

constexpr double kLeastOfLargest = 0.1;  // so that what little was changed shows on a copy
constexpr double kRounding = 1e-12;      // [m]
constexpr double kLeastRange = 1e-6;     // of a map / diagonal: below is rounding

struct LengthUnit {
  double metres;
  const char* name;
};

LengthUnit unit_for(double metres) {
  const double size = std::abs(metres);
  if (size == 0 || size >= 1) return {1, "m"};
  if (size >= 1e-3) return {1e-3, "mm"};
  return size >= 1e-6 ? LengthUnit{1e-6, "um"} : LengthUnit{1e-9, "nm"};
}

/// 1, 2 or 5 times a power of ten, not below the value.
double rounded_up(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * power * (1 + 1e-9)) return step * power;
  return 10 * power;
}

double diagonal_of(const catalog::TriangleMesh& mesh) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [low, high] =
        std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(), [&](auto& a, auto& b) { return a[i] < b[i]; });
    square += std::pow((*high)[i] - (*low)[i], 2);
  }
  return std::sqrt(square);
}

}  // namespace

std::string length_text(double metres) {
  if (std::abs(metres) < kRounding) metres = 0;
  const LengthUnit unit = unit_for(metres);
  return postprocess::short_number(metres / unit.metres, 4) + " " + unit.name;
}

postprocess::PagePicture page_picture(const shape_pipeline::ColourImage& image, const std::string& caption) {
  return {shape_pipeline::encoded_png(image), caption};
}

GrainPages::GrainPages(const fs::path& catalog, const std::vector<DigitizedScan>& outcomes)
    : title_(catalog.filename().string()) {
  std::optional<ShapeCatalog> shapes;  // none where nothing was to be stored
  if (!catalog.empty() && fs::exists(catalog)) shapes.emplace(catalog, ShapeCatalog::Access::read_only);
  const int side = picture_side(outcomes.size());
  for (const DigitizedScan& outcome : outcomes) {
    Grain grain;
    grain.outcome = &outcome;
    grain.entry.name = outcome.name;
    grain.entry.refusal = outcome.reason;
    grain.is_drawn = grains_.size() < kMostDrawn;
    are_all_drawn_ &= grain.is_drawn;
    if (grain.has_shape()) {
      grain.entry.shape = shapes->shape(*shapes->find(outcome.name));
      grain.entry.grade = outcome.summary.grade;
      grain.entry.face_count = outcome.summary.face_count;
    }
    grain.view = shape_pipeline::view_of(grain.entry.shape.mesh.vertices, side);
    grains_.push_back(std::move(grain));
  }
}

void GrainPages::add_input(Grain& grain, const shape_pipeline::ColourImage& picture, const std::string& caption) {
  grain.entry.pictures.insert(grain.entry.pictures.begin(), page_picture(picture, caption));
}

void GrainPages::add_result(Grain& grain) {
  const catalog::TriangleMesh& mesh = grain.entry.shape.mesh;
  grain.entry.pictures.push_back(page_picture(drawn_surface(mesh, grain.view),
                                              "result from two opposite sides: " + std::to_string(mesh.face_count()) +
                                                  " faces, diagonal " + length_text(diagonal_of(mesh))));
}

void GrainPages::add_map(Grain& grain, const DeviationMap& map) {
  const catalog::TriangleMesh& mesh = grain.entry.shape.mesh;
  const double diagonal = diagonal_of(mesh);
  if (map.share_without >= 1) {
    grain.entry.notes.push_back("No map: nowhere is the source near the shape.");
    return;
  }
  const double range =
      rounded_up(std::max({map.all.percentile_95, kLeastOfLargest * map.all.largest, kLeastRange * diagonal}));
  const LengthUnit unit = unit_for(range);
  postprocess::ColourScale scale;
  for (const double share : {-1.0, -0.5, 0.0, 0.5, 1.0})
    scale.colours.push_back(shape_pipeline::deviation_colour(share));
  scale.low = -range / unit.metres;
  scale.high = range / unit.metres;
  scale.unit = unit.name;
  scale.meaning = formatted(
      "distance of the result from its source, positive outside: mean %s (%.3g %% of the diagonal), 95 %% below %s, "
      "largest %s",
      length_text(map.all.mean).c_str(), 100 * map.all.mean / diagonal, length_text(map.all.percentile_95).c_str(),
      length_text(map.all.largest).c_str());
  if (map.share_without > 0)
    scale.meaning +=
        formatted("; grey where the source has nothing near (%.1f %% of the vertices)", 100 * map.share_without);
  grain.entry.scale = std::move(scale);
  grain.entry.pictures.push_back(page_picture(drawn_map(mesh, map.values, range, grain.view), "deviation map"));
}

postprocess::DigitizingReport GrainPages::finished(std::vector<postprocess::SourceEntry> sources) {
  postprocess::DigitizingReport report;
  report.title = title_.empty() ? "Outlines" : title_;
  report.sources = std::move(sources);
  if (!are_all_drawn_)
    report.notes.push_back(formatted("Pictures of the first %zu of %zu grains; the others stand in the tables.",
                                     kMostDrawn, grains_.size()));
  for (Grain& grain : grains_) report.grains.push_back(std::move(grain.entry));
  return report;
}

}  // namespace workflows
