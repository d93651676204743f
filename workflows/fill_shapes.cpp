// SPDX-License-Identifier: Apache-2.0
#include "workflows/fill_shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <utility>

#include "catalog/input_error.h"
#include "catalog/shape_catalog.h"
#include "workflows/plain_name.h"
#include "workflows/scene_place.h"

namespace workflows {
namespace {

std::string catalogue_command(const char* action, const std::filesystem::path& catalogue) {
  return "talus " + std::string(action) + " " + catalogue.string();
}

/// Levels that the engine can hold, of the mode and caps asked for.
std::vector<Level> usable_levels(const catalog::ShapeSummary& shape, const LevelFilter& filter) {
  std::vector<Level> levels = filter(shape.levels);
  std::erase_if(levels, [](const Level& level) { return level.key.vertex_cap > dem_gpu::kMaxPartVertices; });
  return levels;
}

std::string numbers_text(const std::set<int>& numbers) {
  std::string list;
  for (const int number : numbers) list += (list.empty() ? "" : ", ") + std::to_string(number);
  return list;
}

/// What a level is asked to be beside its number of parts: " of at most 16 vertices and 34 faces, enclosing".
std::string limits_text(const LevelFilter& filter) {
  std::string text, joint = " of at most ";
  for (const auto& [cap, things] : {std::pair{filter.vertex_cap, " vertices"}, {filter.face_cap, " faces"}}) {
    if (cap.value_or(0) == 0) continue;
    text += joint + std::to_string(*cap) + things;
    joint = " and ";
  }
  return filter.mode == catalog::FitMode::volume_true ? text : text + ", " + mode_name(filter.mode);
}

/// Of levels to make for a shape that has none of the kind.
constexpr int kUsualParts = 8;

/// The command that makes a level of that kind.
std::string making(const CatalogueShapes& asked, int parts) {
  std::string command = catalogue_command("decompose", asked.catalogue) + " --parts " + std::to_string(parts);
  if (asked.levels.vertex_cap) command += " --vertices " + std::to_string(*asked.levels.vertex_cap);
  if (asked.levels.face_cap.value_or(0) > 0) command += " --faces " + std::to_string(*asked.levels.face_cap);
  if (asked.levels.mode != catalog::FitMode::volume_true) command += " --mode " + mode_name(asked.levels.mode);
  return command;
}

/// Level for the number of parts asked for, without a cap of faces unless asked for; refuses one that is not there.
Level level_of_parts(const catalog::ShapeSummary& shape, const FillDescription& fill, const CatalogueShapes& asked) {
  LevelFilter filter = asked.levels;
  filter.vertex_cap.reset();
  filter.face_cap = asked.levels.face_cap.value_or(0);
  const std::vector<Level> levels = usable_levels(shape, filter);
  std::set<int> caps;
  for (const Level& level : levels)
    if (level.key.parts_asked == *asked.parts) caps.insert(level.key.vertex_cap);
  const std::string parts = std::to_string(*asked.parts), make_it = "make it with: " + making(asked, *asked.parts);
  if (caps.empty())
    throw catalog::InputError(fill.place + ": shape '" + shape.name + "' has no level of " + parts + " parts" +
                              limits_text(filter) + " (it has " + listed(shape.levels) +
                              (shape.levels.empty() ? "); " : "); take one of these, or ") + make_it);
  if (asked.levels.vertex_cap && !caps.contains(*asked.levels.vertex_cap))
    throw catalog::InputError(fill.place + ": shape '" + shape.name + "' has " + parts + " parts with at most " +
                              numbers_text(caps) + " vertices, not " + std::to_string(*asked.levels.vertex_cap) +
                              "; take one of these, or " + make_it);
  const int usual = *std::min_element(caps.begin(), caps.end(), [](int a, int b) {
    return std::abs(a - kUsualVertexCap) < std::abs(b - kUsualVertexCap);
  });
  const int cap = asked.levels.vertex_cap.value_or(usual);
  return *std::find_if(levels.begin(), levels.end(), [&](const Level& level) {
    return level.key.parts_asked == *asked.parts && level.key.vertex_cap == cap;
  });
}

/// The cheapest level within the tolerance asked for; refuses a shape that has none.
Level level_within(const catalog::ShapeSummary& shape, const FillDescription& fill, const CatalogueShapes& asked) {
  const std::vector<Level> levels = usable_levels(shape, asked.levels);
  if (const auto level = cheapest_level(levels, *asked.tolerance)) return *level;
  const auto best = std::min_element(levels.begin(), levels.end(), [](const Level& a, const Level& b) {
    return a.error.symmetric_difference < b.error.symmetric_difference;
  });
  const auto percent = [](double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g %%", 100 * share);
    return std::string(text);
  };
  const std::string refusal = fill.place + ": shape '" + shape.name + "' has no level" + limits_text(asked.levels) +
                              " within tolerance = " + percent(*asked.tolerance) + " (";
  if (best == levels.end())
    throw catalog::InputError(refusal + "it has " + listed(shape.levels) +
                              "); take one of these, or make some with: " + making(asked, kUsualParts));
  const std::string known = refusal + "its best, " + described(best->key) + ", is off by " +
                            percent(best->error.symmetric_difference) + "); allow more";
  if (best->key.parts_asked >= catalog::kMostParts)
    throw catalog::InputError(known + ": no level has more than " + std::to_string(catalog::kMostParts) + " parts");
  throw catalog::InputError(
      known + ", or make finer ones with: " + making(asked, std::min(2 * best->key.parts_asked, catalog::kMostParts)));
}

/// 0 if the catalogue has none.
double descriptor(const catalog::ShapeSummary& shape, const std::string& key) {
  const auto found = shape.descriptors.find(key);
  return found == shape.descriptors.end() ? 0 : found->second;
}

double bounding_radius(const dem_gpu::Shape& shape) {
  if (const auto* sphere = std::get_if<dem_gpu::SphereShape>(&shape.geometry)) return sphere->radius;
  double squared = 0;
  for (const catalog::ConvexPart& part : std::get<dem_gpu::PolyhedralShape>(shape.geometry).parts)
    for (const Point& p : part.vertices) squared = std::max(squared, p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  return std::sqrt(squared);
}

dem_gpu::Shape decomposed(const std::string& name, const std::vector<catalog::ConvexPart>& parts) {
  try {
    return dem_gpu::polyhedral_shape(name, parts);
  } catch (const catalog::InputError& error) {
    throw catalog::InputError(std::string(error.what()) + "; decompose the shape again with other limits");
  }
}

std::string with_millimetres(const char* name, const std::vector<double>& lengths) {
  std::string text = name;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%.6g", i ? "x" : " ", lengths[i] * 1e3);
    text += number;
  }
  return text + " mm";
}

}  // namespace

ShapeCollector::Collected ShapeCollector::add(dem_gpu::Shape shape, ShapeReport report) {
  Collected collected{};
  collected.shape = {static_cast<int>(assembled_.scene.shapes.size()), 0, shape.volume, bounding_radius(shape)};
  report.volume = shape.volume;
  if (const auto* body = std::get_if<dem_gpu::PolyhedralShape>(&shape.geometry)) {
    report.parts = static_cast<int>(body->parts.size());
    for (const catalog::ConvexPart& part : body->parts) {
      report.vertices += static_cast<int>(part.vertex_count());
      report.faces += static_cast<int>(part.face_count());
    }
  }
  assembled_.scene.shapes.push_back(std::move(shape));
  assembled_.shapes.push_back(std::move(report));
  return collected;
}

ShapeCollector::Collected ShapeCollector::ball(const FillDescription& fill, const BallShape& ball) {
  const double diameter = fill.size ? std::cbrt(mean_cubed_size(*fill.size)) : ball.diameter;
  const std::string name = with_millimetres("sphere", {diameter});
  if (const auto known = collected_.find(name); known != collected_.end()) return known->second;
  Collected collected = add(dem_gpu::sphere_shape(name, diameter / 2), {.name = name});
  collected.sieve_size = collected.largest_feret = diameter;
  return collected_[name] = collected;
}

ShapeCollector::Collected ShapeCollector::box(const BoxShape& box) {
  const auto [x, y, z] = box.size;
  const std::string name = with_millimetres("box", {x, y, z});
  if (const auto known = collected_.find(name); known != collected_.end()) return known->second;
  Collected collected = add(dem_gpu::polyhedral_shape(name, {dem_gpu::box_part({x, y, z})}), {.name = name});
  Point edges = box.size;
  std::sort(edges.begin(), edges.end());
  collected.sieve_size = edges[1];
  collected.largest_feret = std::hypot(x, y, z);
  return collected_[name] = collected;
}

ShapeCollector::Collected ShapeCollector::ring(const RingShape& ring) {
  const std::string name = with_millimetres("ring", {ring.diameter, ring.wire}) + ", " + std::to_string(ring.segments) +
                           " segments of " + std::to_string(ring.sides) + " sides";
  if (const auto known = collected_.find(name); known != collected_.end()) return known->second;
  Collected collected = add(ring_shape(name, ring), {.name = name});
  collected.sieve_size = collected.largest_feret = ring.diameter + ring.wire;
  return collected_[name] = collected;
}

std::vector<ShapeCollector::Collected> ShapeCollector::selected(const FillDescription& fill,
                                                                const CatalogueShapes& shapes) {
  const catalog::ShapeCatalog catalogue(shapes.catalogue, catalog::ShapeCatalog::Access::read_only);
  const std::string path = shapes.catalogue.string();
  std::vector<catalog::ShapeId> ids;
  try {
    ids = catalogue.select(shapes.query);
  } catch (const catalog::InputError& error) {
    throw catalog::InputError(fill.place + ": select: " + error.what());
  }
  if (ids.empty())
    throw catalog::InputError(fill.place + ": select = \"" + shapes.query + "\" finds no shape in " + path +
                              "; see what there is with: " + catalogue_command("catalog list", path));
  const auto is_used = [&](const CatalogueUsed& used) { return used.path == shapes.catalogue; };
  if (std::none_of(assembled_.catalogues.begin(), assembled_.catalogues.end(), is_used))
    assembled_.catalogues.push_back({shapes.catalogue, catalog::sha256_of_file(shapes.catalogue)});

  std::vector<Collected> all;
  for (const catalog::ShapeId id : ids) {
    const catalog::ShapeSummary summary = catalogue.summary(id);
    if (!is_plain_name(summary.name))
      throw catalog::InputError(fill.place + ": a shape of " + path + " is named " + shown_name(summary.name) + "; " +
                                kPlainName);
    const Level chosen = shapes.tolerance ? level_within(summary, fill, shapes) : level_of_parts(summary, fill, shapes);
    const std::string key = path + "\n" + summary.name + "\n" + described(chosen.key);
    if (!collected_.contains(key)) {
      const catalog::LevelOfDetail level = catalogue.level(id, chosen.key);
      Collected collected =
          add(decomposed(summary.name, level.parts), {.name = summary.name,
                                                      .symmetric_difference = level.error.symmetric_difference,
                                                      .volume_error = level.error.volume_error});
      collected.sieve_size = descriptor(summary, "axis_intermediate_obb");
      collected.largest_feret = descriptor(summary, "feret_max");
      collected_[key] = collected;
    }
    all.push_back(collected_[key]);
  }
  return all;
}

std::vector<FillShape> ShapeCollector::shapes_of(const FillDescription& fill) {
  const std::vector<Collected> all = at_place(fill.place, [&]() -> std::vector<Collected> {
    if (const auto* sphere = std::get_if<BallShape>(&fill.shapes)) return {ball(fill, *sphere)};
    if (const auto* block = std::get_if<BoxShape>(&fill.shapes)) return {box(*block)};
    if (const auto* hoop = std::get_if<RingShape>(&fill.shapes)) return {ring(*hoop)};
    return selected(fill, std::get<CatalogueShapes>(fill.shapes));
  });

  std::vector<FillShape> shapes;
  for (const Collected& one : all) {
    shapes.push_back(one.shape);
    const double equivalent = std::cbrt(6 * one.shape.volume / std::numbers::pi);
    shapes.back().size = fill.definition == SizeDefinition::sieve               ? one.sieve_size
                         : fill.definition == SizeDefinition::volume_equivalent ? equivalent
                                                                                : one.largest_feret;
    if (!(one.shape.volume > 0))
      throw catalog::InputError(fill.place + ": shape '" +
                                assembled_.scene.shapes[static_cast<std::size_t>(one.shape.index)].name +
                                "' has no volume; check the unit of its size");
    if (!(shapes.back().size > 0))
      throw catalog::InputError(
          fill.place + ": shape '" + assembled_.scene.shapes[static_cast<std::size_t>(one.shape.index)].name +
          "' has no descriptor for its " + name_of(fill.definition) + " size in the catalogue; digitize it again");
  }
  return shapes;
}

}  // namespace workflows
