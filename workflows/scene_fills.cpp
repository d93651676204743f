// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "workflows/scene_sections.h"

namespace workflows {
namespace {

constexpr std::int64_t kMostBodies = 5'000'000;
constexpr int kMostParts = 1024;
// Faces of a simplicial part with as many vertices as a part may have.
constexpr int kMostFaces = 2 * dem_gpu::kMaxPartVertices - 4;
// Of a ring: the depth field of as many takes 15 s to set up, of twice as many a minute.
constexpr int kMostRingFaces = 5000;
// Tables of passing must end at 100 % within this share.
constexpr double kFullShareTolerance = 1e-6;
// A region may end as far beyond a face of a periodic box, in widths of the box: units converted on the way.
constexpr double kRegionRounding = 1e-12;

ShapeSource read_shapes(TomlTable& table, const std::filesystem::path& base_folder) {
  const int sources = table.has("shapes_from") + table.has("sphere") + table.has("box") + table.has("ring");
  if (sources != 1)
    table.refuse("state the shape once: shapes_from = \"ore.talus\", sphere = {...}, box = {...} or ring = {...}");
  if (table.has("sphere")) {
    TomlTable sphere = table.table("sphere");
    const BallShape ball{sphere.quantity("diameter", Dimension::length, kPositive, 1.0)};
    if (!sphere.has("diameter") && !table.has("size"))
      table.refuse("sphere", "state the sphere's diameter, or a [fill.size]");
    if (sphere.has("diameter") && table.has("size"))
      table.refuse("sphere", "diameter and size both state how large the spheres are; keep one");
    sphere.finish();
    return ball;
  }
  if (table.has("box")) {
    TomlTable box = table.table("box");
    const BoxShape shape{box.vector("size", Dimension::length)};
    for (const double edge : shape.size)
      if (!(edge > 0)) box.refuse("size", "size must be three edges, each more than 0");
    box.finish();
    return shape;
  }
  if (table.has("ring")) return read_ring(table.table("ring"));
  return read_catalogue_shapes(table, base_folder);
}

FillRegion read_region(TomlTable where) {
  if (where.has("cylinder") == where.has("box"))
    where.refuse("state one region: {cylinder = {base, axis, radius, length}} or {box = {min, max}}");
  FillRegion region;
  if (where.has("cylinder")) {
    TomlTable table = where.table("cylinder");
    CylinderRegion cylinder;
    cylinder.base = table.vector("base", Dimension::length);
    cylinder.axis = table.direction("axis");
    cylinder.radius = table.quantity("radius", Dimension::length, kPositive);
    cylinder.length = table.quantity("length", Dimension::length, kPositive);
    table.finish();
    region = cylinder;
  } else {
    TomlTable table = where.table("box");
    BoxRegion box{table.vector("min", Dimension::length), table.vector("max", Dimension::length)};
    for (int i = 0; i < 3; ++i)
      if (!(box.low[i] < box.high[i])) table.refuse("max", "max must be larger than min along x, y and z");
    table.finish();
    region = box;
  }
  where.finish();
  return region;
}

/// Lowest and highest coordinate of a region along an axis [m].
std::array<double, 2> extent(const FillRegion& region, std::size_t axis) {
  if (const auto* box = std::get_if<BoxRegion>(&region)) return {box->low[axis], box->high[axis]};
  const auto& cylinder = std::get<CylinderRegion>(region);
  const double along = cylinder.axis[axis], end = cylinder.base[axis] + along * cylinder.length;
  const double rim = cylinder.radius * std::sqrt(std::max(1 - along * along, 0.0));
  return {std::min(cylinder.base[axis], end) - rim, std::max(cylinder.base[axis], end) + rim};
}

void refuse_outside(TomlTable& fill, const FillRegion& region, const dem_gpu::PeriodicBox& box) {
  constexpr std::array<char, 3> axes{'x', 'y', 'z'};
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const auto& span = box.span[axis];
    if (!span) continue;
    const auto [low, high] = extent(region, axis);
    const double rounding = kRegionRounding * (span->high - span->low);
    if (low >= span->low - rounding && high <= span->high + rounding) continue;
    fill.refuse("where", std::string("the region spans ") + std::to_string(low) + " .. " + std::to_string(high) +
                             " m along " + axes[axis] + ", the periodic box only " + std::to_string(span->low) +
                             " .. " + std::to_string(span->high) + " m; shrink the region or widen the box");
  }
}

FillLayout read_layout(TomlTable& table) {
  FillLayout layout;
  constexpr Packing packings[] = {Packing::dense, Packing::hexagonal, Packing::cubic};
  if (table.has("packing")) layout.packing = packings[table.choice("packing", {"dense", "hexagonal", "cubic"})];
  layout.clearance = table.quantity("clearance", Dimension::ratio, kNotNegative, layout.clearance);
  const Bounds share{0, 1, false, "from 0 to 1"};
  layout.jitter = table.quantity("jitter", Dimension::ratio, share, layout.jitter);
  if (table.has("seed"))
    layout.seed = static_cast<std::uint64_t>(table.integer("seed", 0, std::numeric_limits<std::int64_t>::max()));
  return layout;
}

SizeDistribution read_table(TomlTable& table, SizeBasis basis) {
  SizeDistribution distribution{basis, {}, {}};
  const toml::array& rows = table.array("passing");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string place = "passing[" + std::to_string(i) + "]";
    const toml::array* row = rows[i].as_array();
    if (!row || row->size() != 2) table.refuse("passing", place + " must be a pair [size, percent passing]");
    const double size = table.element((*row)[0], place + " size", Dimension::length, kPositive);
    const Bounds percent{0, 100 * (1 + kFullShareTolerance), false, "from 0 to 100, percent passing"};
    const double share = table.element((*row)[1], place + " percent", Dimension::ratio, percent) / 100;
    if (i > 0 && !(size > distribution.size.back()))
      table.refuse("passing", place + ": sizes must ascend; sort the table");
    if (i > 0 && share < distribution.passing.back())
      table.refuse("passing", place + ": percent passing must not fall; it is cumulative");
    distribution.size.push_back(size);
    distribution.passing.push_back(share);
  }
  if (rows.size() < 2) table.refuse("passing", "passing needs two rows or more: [[size, 0], ..., [size, 100]]");
  if (distribution.passing.front() != 0)
    table.refuse("passing", "passing must start at 0: add a first row with the smallest size that occurs");
  if (std::abs(distribution.passing.back() - 1) > kFullShareTolerance)
    table.refuse("passing",
                 "passing ends at " + std::to_string(100 * distribution.passing.back()) + "; it must end at 100");
  distribution.passing.back() = 1;
  return distribution;
}

}  // namespace

CatalogueShapes read_catalogue_shapes(TomlTable& table, const std::filesystem::path& base_folder) {
  CatalogueShapes shapes;
  shapes.catalogue = base_folder / table.text("shapes_from");
  shapes.query = table.text("select", "");
  if (table.has("tolerance")) {
    if (table.has("parts")) table.refuse("tolerance", "tolerance stands beside parts: give one of them");
    const Bounds share{0, 1, true, "more than 0, at most 100 %"};
    shapes.tolerance = table.quantity("tolerance", Dimension::ratio, share);
  } else {
    shapes.parts = static_cast<int>(table.integer("parts", 1, kMostParts));
  }
  if (table.has("vertices"))
    shapes.levels.vertex_cap = static_cast<int>(table.integer("vertices", 4, dem_gpu::kMaxPartVertices));
  if (table.has("faces")) shapes.levels.face_cap = static_cast<int>(table.integer("faces", 0, kMostFaces));
  if (table.has("mode"))
    shapes.levels.mode = static_cast<catalog::FitMode>(table.choice("mode", catalog::mode_names()));
  return shapes;
}

RingShape read_ring(TomlTable table) {
  RingShape ring;
  ring.diameter = table.quantity("diameter", Dimension::length, kPositive);
  const Bounds thin{0, ring.diameter / 2, true, "more than 0, less than half the ring's diameter"};
  ring.wire = table.quantity("wire", Dimension::length, thin);
  if (!(ring.wire < ring.diameter / 2))
    table.refuse("wire", "wire closes the ring's hole; it must be " + std::string(thin.words));
  if (table.has("segments")) ring.segments = static_cast<int>(table.integer("segments", 4, kMostParts));
  if (table.has("sides")) ring.sides = static_cast<int>(table.integer("sides", 3, dem_gpu::kMaxFaceCorners));
  if (ring.segments * ring.sides > kMostRingFaces)
    table.refuse("segments", "segments x sides is " + std::to_string(ring.segments * ring.sides) + "; at most " +
                                 std::to_string(kMostRingFaces) + " faces, or the set-up takes minutes");
  table.finish();
  return ring;
}

void read_size_distribution(TomlTable& table, FillDescription& fill) {
  const int kind = table.choice("kind", {"table", "rosin-rammler", "lognormal", "single"});
  constexpr SizeDefinition definitions[] = {SizeDefinition::sieve, SizeDefinition::volume_equivalent,
                                            SizeDefinition::max_feret};
  fill.definition = definitions[table.choice("definition", {"sieve", "volume-equivalent", "max-feret"})];
  const SizeBasis basis = table.choice("basis", {"mass", "number"}) == 0 ? SizeBasis::mass : SizeBasis::number;
  if (kind == 0) {
    fill.size = read_table(table, basis);
  } else if (kind == 3) {
    fill.size = single_size(table.quantity("size", Dimension::length, kPositive));
    fill.size->basis = basis;
  } else {
    const double least = table.quantity("min", Dimension::length, kPositive);
    const double most = table.quantity("max", Dimension::length, kPositive);
    if (!(least < most)) table.refuse("max", "max must be larger than min");
    const Bounds deviation{1, 20, true, "more than 1, at most 20"};
    const Bounds spread{0.1, 20, false, "from 0.1 to 20"};
    if (kind == 1) {
      const double d63 = table.quantity("d63", Dimension::length, kPositive);
      fill.size = rosin_rammler(basis, d63, table.quantity("spread", Dimension::ratio, spread), least, most);
    } else {
      const double d50 = table.quantity("d50", Dimension::length, kPositive);
      fill.size = lognormal(basis, d50, table.quantity("sigma_g", Dimension::ratio, deviation), least, most);
    }
    if (!std::isfinite(fill.size->passing.back()) || fill.size->passing.back() <= 0.5)
      table.refuse("min", "no part of the distribution lies between min and max; check the units");
  }
  table.finish();
}

std::vector<FillDescription> read_fills(TomlTable& file, const dem_gpu::Scene& scene,
                                        const std::filesystem::path& base_folder) {
  std::vector<FillDescription> fills;
  for (TomlTable& table : file.tables("fill")) {
    FillDescription fill;
    fill.name = table.plain_name("name", "fill_" + std::to_string(fills.size()));
    table.rename("fill \"" + fill.name + "\"");
    for (const FillDescription& other : fills)
      if (other.name == fill.name) table.refuse("name", "two fills are named \"" + fill.name + "\"; names must differ");
    fill.place = table.place() + ": " + table.title();
    fill.shapes = read_shapes(table, base_folder);
    fill.material = read_material_name(table, "material", scene.materials);
    if (table.has("count") == table.has("mass")) table.refuse("state how much: either count or mass");
    if (table.has("count"))
      fill.amount = table.integer("count", 1, kMostBodies);
    else
      fill.amount = table.quantity("mass", Dimension::mass, kPositive);
    if (std::optional<TomlTable> size = table.optional_table("size")) read_size_distribution(*size, fill);
    fill.region = read_region(table.table("where"));
    if (scene.periodic) refuse_outside(table, fill.region, *scene.periodic);
    fill.layout = read_layout(table);
    if (table.has("velocity")) fill.velocity = table.vector("velocity", Dimension::speed, kSpeed);
    table.finish();
    fills.push_back(std::move(fill));
  }
  return fills;
}

}  // namespace workflows
