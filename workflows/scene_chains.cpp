// SPDX-License-Identifier: Apache-2.0
#include "workflows/scene_sections.h"

namespace workflows {
namespace {

constexpr std::int64_t kMostLinks = 100'000;

ChainLayout read_layout(TomlTable& table) {
  ChainLayout layout;
  layout.links = static_cast<int>(table.integer("links", 1, kMostLinks));
  layout.start = to_vec3(table.vector("start", Dimension::length));
  layout.is_closed = table.flag("closed", false);
  if (layout.is_closed)
    layout.direction = to_vec3(table.direction("axis"));
  else if (table.has("direction"))
    layout.direction = to_vec3(table.direction("direction"));
  const Bounds share{0, 1, true, "more than 0, at most 100 % of the wire"};
  layout.gap = table.quantity("gap", Dimension::ratio, share, layout.gap);
  layout.holds_first = table.flag("hold_first", false);
  return layout;
}

}  // namespace

std::vector<ChainDescription> read_chains(TomlTable& file, const dem_gpu::Scene& scene,
                                          const std::filesystem::path& base_folder) {
  std::vector<ChainDescription> chains;
  for (TomlTable& table : file.tables("chain")) {
    ChainDescription chain;
    chain.name = table.plain_name("name", "chain_" + std::to_string(chains.size()));
    table.rename("chain \"" + chain.name + "\"");
    chain.place = table.place() + ": " + table.title();
    if (table.has("ring") == table.has("shapes_from"))
      table.refuse("state the link once: ring = {diameter = ..., wire = ...} or shapes_from = \"ore.talus\"");
    if (table.has("ring"))
      chain.link = read_ring(table.table("ring"));
    else
      chain.link = read_catalogue_shapes(table, base_folder);
    chain.material = read_material_name(table, "material", scene.materials);
    chain.layout = read_layout(table);
    if (table.has("velocity")) chain.velocity = table.vector("velocity", Dimension::speed, kSpeed);
    table.finish();
    chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace workflows
