// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/made_shapes.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "catalog/input_error.h"
#include "workflows/plain_name.h"
#include "workflows/stage_tool.h"
#include "workflows/units.h"

namespace workflows {
namespace {

bool is_same(const catalog::Provenance& a, const catalog::Provenance& b) {
  return a.source_file == b.source_file && a.source_sha256 == b.source_sha256 && a.options == b.options &&
         a.tool_version == b.tool_version;
}

double descriptor(const MadeShape& shape, const char* name) {
  const auto found = shape.summary.descriptors.find(name);
  return found == shape.summary.descriptors.end() ? 0 : found->second;
}

}  // namespace

std::vector<MadeShape> make_shapes(catalog::ShapeCatalog& catalog, const std::vector<ShapeOrder>& orders) {
  std::vector<MadeShape> made;
  for (const ShapeOrder& order : orders) {
    if (!is_plain_name(order.name)) throw catalog::InputError(shown_name(order.name) + ": " + kPlainName);
    auto id = catalog.find(order.name);
    const bool is_there = id && is_same(catalog.shape(*id).provenance, order.provenance);
    if (!is_there) {
      catalog::ShapeRecord shape = order.make();
      shape.name = order.name;
      shape.provenance = order.provenance;
      id = catalog.store_shape(shape);
    }
    made.push_back({order.name, is_there ? "skipped" : "stored", catalog.summary(*id)});
  }
  return made;
}

int report_made_shapes(const std::string& stage, const std::vector<MadeShape>& shapes, bool is_json) {
  std::string failed;
  if (!is_json)
    std::printf("%-28s %-8s %5s %12s %10s %7s %7s %7s %10s %10s %10s\n", "name", "status", "grade", "volume[m3]",
                "sieve[m]", "faces", "S/I", "I/L", "sphericity", "convexity", "angularity");
  for (const MadeShape& shape : shapes) {
    if (is_json) {
      const nlohmann::ordered_json row{{"name", shape.name},
                                       {"status", shape.status},
                                       {"grade", shape.summary.grade},
                                       {"descriptors", shape.summary.descriptors},
                                       {"failed_checks", shape.summary.failed_checks}};
      std::printf("%s\n", row.dump().c_str());
    } else {
      std::printf("%-28s %-8s %5d %12.5g %10.4g %7zu %7.4f %7.4f %10.4f %10.4f %10.4f\n", shape.name.c_str(),
                  shape.status.c_str(), shape.summary.grade, shape.summary.volume,
                  descriptor(shape, "sieve_size_second_axis"), shape.summary.face_count,
                  descriptor(shape, "zingg_s_over_i"), descriptor(shape, "zingg_i_over_l"),
                  descriptor(shape, "sphericity_wadell"), descriptor(shape, "convexity_volume_ratio"),
                  descriptor(shape, "angularity_corner_radius"));
    }
    for (const std::string& check : shape.summary.failed_checks) failed += "  " + shape.name + ": " + check + "\n";
  }
  if (failed.empty()) return kDone;
  std::fprintf(stderr, "%s: stored with checks that did not pass:\n%s", stage.c_str(), failed.c_str());
  return kCheckNotPassed;
}

catalog::ShapeCatalog catalogue_to_fill(const std::filesystem::path& path) {
  if (std::filesystem::is_regular_file(path) && std::filesystem::file_size(path) == 0)
    throw catalog::InputError(
        path.string() + ": is an empty file, expected a catalogue or a new name; delete the file or name another");
  return {path, catalog::ShapeCatalog::Access::read_write};
}

double positive_length(const std::string& option, const std::string& text) {
  const std::optional<double> length = parse_quantity(text, Dimension::length);
  if (!length || !(*length > 0))
    throw catalog::UsageError(option + ": expected a length above 0 such as '12 mm', found '" + text + "'");
  return *length;
}

}  // namespace workflows
