// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/micrograph_tables.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "workflows/text_format.h"

namespace workflows {
namespace {

using shape_pipeline::Micrograph;
using shape_pipeline::MicrographGrain;
using shape_pipeline::Outline;
using shape_pipeline::OutlineDescriptor;

shape_pipeline::PlanePoint middle_of(const Outline& outline) {
  shape_pipeline::PlanePoint low = outline.front(), high = low;
  for (const auto& point : outline)
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], point[k]);
      high[k] = std::max(high[k], point[k]);
    }
  return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2};
}

/// To a thousandth of a pixel, which is finer than any outline is known.
nlohmann::ordered_json points_of(const Outline& outline) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const auto& [x, y] : outline) points.push_back({std::round(1000 * x) / 1000, std::round(1000 * y) / 1000});
  return points;
}

nlohmann::ordered_json origin_of(const catalog::Provenance& provenance) {
  return {{"source_file", provenance.source_file},
          {"source_sha256", provenance.source_sha256},
          {"tool_version", provenance.tool_version},
          {"options", nlohmann::ordered_json::parse(provenance.options)}};
}

}  // namespace

std::string outline_table(const std::string& image, const Micrograph& micrograph) {
  std::string text = "grain[-],image[-],middle_x[m],middle_y[m]";
  for (const OutlineDescriptor& descriptor : micrograph.grains.front().descriptors)
    text += "," + descriptor.name + "[" + descriptor.unit + "]";
  text += "\n";
  for (std::size_t g = 0; g < micrograph.grains.size(); ++g) {
    const auto [x, y] = middle_of(micrograph.grains[g].outline);
    text += formatted("%zu,%s,%.9g,%.9g", g + 1, image.c_str(), x * micrograph.pixel_size, y * micrograph.pixel_size);
    for (const OutlineDescriptor& descriptor : micrograph.grains[g].descriptors)
      text += std::isfinite(descriptor.value) ? formatted(",%.9g", descriptor.value) : ",";
    text += "\n";
  }
  return text;
}

std::string outline_json(const Micrograph& micrograph, const catalog::Provenance& provenance) {
  nlohmann::ordered_json root{{"version", 1},
                              {"frame", "pixels from the image's upper left corner, x to the right, y down"},
                              {"width", micrograph.width},
                              {"height", micrograph.height},
                              {"strip_top", micrograph.strip_top},
                              {"pixel_size", micrograph.pixel_size},
                              {"scale_bar_pixels", micrograph.bar_pixels},
                              {"specks", micrograph.specks},
                              {"films", micrograph.films}};
  root["provenance"] = origin_of(provenance);
  for (const char* kind : {"grains", "cut_by_border"}) {
    nlohmann::ordered_json outlines = nlohmann::ordered_json::array();
    for (const MicrographGrain& grain : kind[0] == 'g' ? micrograph.grains : micrograph.at_border)
      outlines.push_back(points_of(grain.outline));
    root[kind] = std::move(outlines);
  }
  return root.dump() + "\n";
}

std::string population_json(const shape_pipeline::MatchedPopulation& population,
                            const catalog::Provenance& provenance) {
  nlohmann::ordered_json root{{"version", 1},
                              {"grains", population.grains.size()},
                              {"assumption", population.assumption},
                              {"ratio_power", population.ratio_power},
                              {"roughness_factor", population.roughness_factor}};
  root["provenance"] = origin_of(provenance);
  for (const shape_pipeline::FormComparison& row : population.comparison)
    root["comparison"].push_back({{"name", row.name},
                                  {"measured_mean", row.measured_mean},
                                  {"measured_spread", row.measured_spread},
                                  {"made_mean", row.made_mean},
                                  {"made_spread", row.made_spread},
                                  {"agrees", row.agrees(static_cast<int>(population.grains.size()))}});
  return root.dump(1) + "\n";
}

}  // namespace workflows
