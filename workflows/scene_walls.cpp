// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "catalog/input_error.h"
#include "catalog/nearest_word.h"
#include "dem_gpu/mesh_probe.h"
#include "workflows/convex_hull.h"
#include "workflows/scene_sections.h"
#include "workflows/stl_file.h"

namespace workflows {
namespace {

using dem_gpu::Vec3;
using dem_gpu::Wall;

// How far a lifter reaches into the shell, and past the ends of one without a stated length / its height: no gap for
// corners of particles to find.
constexpr double kLifterReach = 0.05;
constexpr int kMostLifters = 1000;
constexpr Bounds kTurning{-1e9, 1e9, false, "from -1e9 to 1e9 rad/s"};
constexpr Bounds kFrequency{0, 1e12, true, "more than 0, at most 1e12 rad/s"};

/// oscillate = [0, 0, "1 mm"] and swing = "2 deg" about `axis`, with frequency and phase.
void read_oscillation(TomlTable& table, dem_gpu::Motion& motion) {
  if (table.has("oscillate")) motion.amplitude = to_vec3(table.vector("oscillate", Dimension::length));
  if (table.has("swing"))
    motion.angular_amplitude = table.quantity("swing", Dimension::angle) * to_vec3(table.direction("axis"));
  motion.frequency = table.quantity("frequency", Dimension::angular_velocity, kFrequency) / (2 * std::numbers::pi);
  motion.phase = table.quantity("phase", Dimension::angle, kAny, 0);
}

dem_gpu::Motion read_motion(TomlTable& table) {
  dem_gpu::Motion motion;
  const bool oscillates = table.has("oscillate") || table.has("swing");
  if (!table.has("rotate") && !table.has("translate") && !oscillates)
    table.refuse("state rotate or swing, with axis and centre, translate, or oscillate");
  if (table.has("rotate")) {
    const double speed = table.quantity("rotate", Dimension::angular_velocity, kTurning);
    motion.angular_velocity = speed * to_vec3(table.direction("axis"));
  }
  if (table.has("rotate") || table.has("swing"))
    motion.rotation_centre = to_vec3(table.vector("centre", Dimension::length));
  if (table.has("translate")) motion.velocity = to_vec3(table.vector("translate", Dimension::speed, kSpeed));
  if (oscillates) read_oscillation(table, motion);
  motion.start_time = table.quantity("start", Dimension::time, kNotNegative, 0);
  motion.ramp_time = table.quantity("ramp", Dimension::time, kNotNegative, 0);
  table.finish();
  return motion;
}

/// `motion = "drum"` or `motion = {rotate = ...}`; at rest if absent. Walls of one named motion are a group.
void read_motion_of(TomlTable& table, const NamedMotions& motions, Wall& wall) {
  if (!table.has("motion")) return;
  if (!table.is_text("motion")) {
    TomlTable motion = table.table("motion");
    wall.motion = read_motion(motion);
    return;
  }
  std::vector<std::string> names;
  for (const auto& [name, motion] : motions) names.push_back(name);
  if (names.empty())
    table.refuse("motion", "no motion is defined; add a section [motion." + table.text("motion") + "]");
  wall.group = names[static_cast<std::size_t>(table.choice("motion", names))];
  wall.motion = motions.at(wall.group);
}

Vec3 read_point(TomlTable& table, std::string_view key) { return to_vec3(table.vector(key, Dimension::length)); }

catalog::ConvexPart moved(catalog::ConvexPart part, const dem_gpu::Quaternion& rotation, const Vec3& centre) {
  for (Point& vertex : part.vertices) vertex = to_point(dem_gpu::rotate(rotation, to_vec3(vertex)) + centre);
  for (catalog::ConvexFace& face : part.faces) {
    face.plane.normal = to_point(dem_gpu::rotate(rotation, to_vec3(face.plane.normal)));
    face.plane.offset += dem_gpu::dot(to_vec3(face.plane.normal), centre);
  }
  return part;
}

/// The body that points span; what is flat is refused at `key`.
catalog::ConvexPart solid_of(const TomlTable& table, std::string_view key, const std::vector<Point>& points) {
  try {
    catalog::ConvexPart part = convex_hull(points);
    dem_gpu::polyhedral_shape("solid", {part});
    return part;
  } catch (const catalog::InputError& error) {
    table.refuse(key, std::string(key) + ": no convex solid (" + error.what() + ")");
  }
}

catalog::ConvexPart read_block(TomlTable& table) {
  const Vec3 size = read_point(table, "size");
  if (!(size.x > 0 && size.y > 0 && size.z > 0)) table.refuse("size", "size must be three edges, each more than 0");
  const Vec3 centre = read_point(table, "centre");
  dem_gpu::Quaternion rotation;
  if (std::optional<TomlTable> turn = table.optional_table("rotation")) {
    const Vec3 axis = to_vec3(turn->direction("axis"));
    rotation = dem_gpu::axis_angle(axis, turn->quantity("angle", Dimension::angle));
    turn->finish();
  }
  std::vector<Point> corners;
  for (int corner = 0; corner < 8; ++corner)
    corners.push_back(
        {(corner & 1 ? 0.5 : -0.5) * size.x, (corner & 2 ? 0.5 : -0.5) * size.y, (corner & 4 ? 0.5 : -0.5) * size.z});
  return moved(solid_of(table, "size", corners), rotation, centre);
}

catalog::ConvexPart read_polyhedron(TomlTable& table) {
  const toml::array& rows = table.array("vertices");
  if (rows.size() > static_cast<std::size_t>(dem_gpu::kMaxPartVertices))
    table.refuse("vertices", "vertices has " + std::to_string(rows.size()) + " points; at most " +
                                 std::to_string(dem_gpu::kMaxPartVertices) + " are possible");
  std::vector<Point> vertices;
  for (std::size_t i = 0; i < rows.size(); ++i)
    vertices.push_back(table.element_vector(rows[i], "vertices[" + std::to_string(i) + "]", Dimension::length));
  return solid_of(table, "vertices", vertices);
}

/// Are the bodies inside? `bodies = "inside"` or "outside".
bool has_bodies_inside(TomlTable& table, bool if_absent) {
  return table.has("bodies") ? table.choice("bodies", {"inside", "outside"}) == 0 : if_absent;
}

dem_gpu::SolidSide read_solid_side(TomlTable& table) {
  return has_bodies_inside(table, true) ? dem_gpu::SolidSide::around : dem_gpu::SolidSide::within;
}

dem_gpu::MeshObject read_mesh(TomlTable& table, const std::filesystem::path& base_folder) {
  const std::string unit = table.text("unit");
  const std::optional<double> metres = length_unit(unit);
  if (!metres)
    table.refuse("unit", "unit is \"" + unit + "\"; expected the file's unit of length, one of " +
                             accepted_units(Dimension::length));
  dem_gpu::MeshObject object;
  object.thickness = table.optional_quantity("thickness", Dimension::length, kPositive);
  object.is_container = has_bodies_inside(table, false);
  object.depth = table.quantity("depth", Dimension::length, kNotNegative, 0);
  const std::string file = table.text("file");
  try {
    object.mesh = read_stl(base_folder / file, *metres);
    dem_gpu::MeshProbe check(object);
  } catch (const catalog::InputError& error) {
    table.refuse("file", error.what());
  }
  return object;
}

decltype(Wall::geometry) read_geometry(TomlTable& table, const std::filesystem::path& base_folder) {
  const std::vector<std::string> types{"plane", "disc", "cylinder", "cone", "block", "polyhedron", "sphere", "mesh"};
  const auto direction = [&](const char* key) { return to_vec3(table.direction(key)); };
  const auto length = [&](const char* key) { return table.quantity(key, Dimension::length, kPositive); };
  const auto radius = [&](const char* key) { return table.quantity(key, Dimension::length, kNotNegative); };
  switch (table.choice("type", types)) {
    case 0:
      return dem_gpu::Plane{read_point(table, "point"), direction("normal")};
    case 1:
      return dem_gpu::Disc{read_point(table, "centre"), direction("normal"), length("radius"),
                           table.optional_quantity("thickness", Dimension::length, kPositive)};
    case 2:
      return dem_gpu::Cylinder{read_point(table, "base"), direction("axis"), length("length"), length("radius"),
                               read_solid_side(table)};
    case 3: {
      const dem_gpu::Cone cone{read_point(table, "base"), direction("axis"),    length("length"),
                               radius("base_radius"),     radius("top_radius"), read_solid_side(table)};
      if (cone.base_radius == cone.top_radius)
        table.refuse("top_radius", "base_radius and top_radius are equal; use type = \"cylinder\"");
      return cone;
    }
    case 4:
      return dem_gpu::VolumeObject{read_block(table)};
    case 5:
      return dem_gpu::VolumeObject{read_polyhedron(table)};
    case 6:
      return dem_gpu::Ball{read_point(table, "centre"), length("radius"), read_solid_side(table)};
    default:
      return read_mesh(table, base_folder);
  }
}

/// A name is what results are told apart by.
void refuse_equal_name(const TomlTable& table, const std::string& name, const std::vector<Wall>& walls) {
  if (std::any_of(walls.begin(), walls.end(), [&](const Wall& wall) { return wall.name == name; }))
    table.refuse("name", "two walls are named \"" + name + "\"; names must differ");
}

Wall read_wall(TomlTable& table, const NamedMotions& motions, const std::vector<dem_gpu::Material>& materials,
               const std::filesystem::path& base_folder) {
  Wall wall;
  wall.name = table.plain_name("name");
  table.rename("wall \"" + wall.name + "\"");
  wall.geometry = read_geometry(table, base_folder);
  wall.material = read_material_name(table, "material", materials);
  wall.contact_class = table.plain_name("class", "");
  read_motion_of(table, motions, wall);
  wall.removed_at = table.optional_quantity("open_at", Dimension::time, kNotNegative);
  table.finish();
  return wall;
}

/// A bar along the shell's inside: trapezium of `width` at the shell, `height` towards the axis.
struct LifterSection {
  double width, height;  // [m]
  double face_angle;     // between the flanks and the shell [rad]
};

catalog::ConvexPart lifter_part(const TomlTable& table, const dem_gpu::Cylinder& shell, const LifterSection& section,
                                double angle, const std::array<double, 2>& ends) {
  const Vec3 start = dem_gpu::any_perpendicular(shell.axis);
  const Vec3 outward = std::cos(angle) * start + std::sin(angle) * dem_gpu::cross(shell.axis, start);
  const Vec3 along_shell = dem_gpu::cross(shell.axis, outward);
  const double reach = kLifterReach * section.height;
  const double slope = 1 / std::tan(section.face_angle);  // half-width lost per height
  std::vector<Point> corners;
  for (const double end : ends)
    for (const double radius : {shell.radius + reach, shell.radius - section.height})
      for (const double side : {-1.0, 1.0}) {
        const double half_width = section.width / 2 - (shell.radius - radius) * slope;
        corners.push_back(to_point(shell.base + end * shell.axis + radius * outward + side * half_width * along_shell));
      }
  return solid_of(table, section.height < section.width ? "height" : "width", corners);
}

void read_lifters(TomlTable& table, dem_gpu::Scene& scene) {
  const std::string prefix = table.plain_name("name", "lifter");
  table.rename("lifters \"" + prefix + "\"");
  std::vector<std::string> names;
  for (const Wall& wall : scene.walls)
    if (std::holds_alternative<dem_gpu::Cylinder>(wall.geometry)) names.push_back(wall.name);
  if (names.empty())
    table.refuse(
        "lifters need a wall of type \"cylinder\" to stand on, and the scene has none; add one, or give the "
        "lifters as walls of type \"block\"");
  const std::string& shell_name = names[static_cast<std::size_t>(table.choice("on", names))];
  const Wall shell_wall =
      *std::find_if(scene.walls.begin(), scene.walls.end(), [&](const Wall& wall) { return wall.name == shell_name; });
  const auto& shell = std::get<dem_gpu::Cylinder>(shell_wall.geometry);

  const auto count = table.integer("count", 1, kMostLifters);
  const Bounds in_shell{0, shell.radius, true, "more than 0, less than the shell's radius"};
  LifterSection section{};
  section.width = table.quantity("width", Dimension::length, in_shell);
  section.height = table.quantity("height", Dimension::length, in_shell);
  const Bounds flank{0, std::numbers::pi / 2, true, "more than 0, at most 90 deg"};
  section.face_angle = table.quantity("face_angle", Dimension::angle, flank, std::numbers::pi / 2);
  if (section.width / 2 <= section.height / std::tan(section.face_angle))
    table.refuse("face_angle", "the flanks meet below the lifter's height; widen it or raise face_angle");
  const double first = table.quantity("first_angle", Dimension::angle, kAny, 0);
  const double reach = kLifterReach * section.height;
  std::array<double, 2> ends{-reach, shell.length + reach};
  if (const auto length = table.optional_quantity("length", Dimension::length, kPositive))
    ends = {(shell.length - *length) / 2, (shell.length + *length) / 2};

  for (std::int64_t i = 0; i < count; ++i) {
    char number[16];
    std::snprintf(number, sizeof number, "_%02d", static_cast<int>(i));
    Wall lifter;
    lifter.name = prefix + number;
    refuse_equal_name(table, lifter.name, scene.walls);
    const double angle = first + 2 * std::numbers::pi * double(i) / double(count);
    lifter.geometry = dem_gpu::VolumeObject{lifter_part(table, shell, section, angle, ends)};
    lifter.material =
        table.has("material") ? read_material_name(table, "material", scene.materials) : shell_wall.material;
    lifter.contact_class = table.plain_name("class", "lifter");
    lifter.motion = shell_wall.motion;
    lifter.group = shell_wall.group;
    scene.walls.push_back(lifter);
  }
  table.finish();
}

}  // namespace

NamedMotions read_motions(TomlTable& file, SceneDescription& description) {
  NamedMotions motions;
  for (TomlTable& table : file.named_tables("motion")) {
    description.motions.push_back(table.name());
    description.places["motion '" + table.name() + "'"] = table.place();
    motions[table.name()] = read_motion(table);
  }
  return motions;
}

void read_walls(TomlTable& file, const NamedMotions& motions, const std::filesystem::path& base_folder,
                SceneDescription& description) {
  dem_gpu::Scene& scene = description.scene;
  std::size_t known = 0;
  const auto note_places = [&](const TomlTable& table) {
    for (; known < scene.walls.size(); ++known)
      description.places["wall '" + scene.walls[known].name + "'"] = table.place();
  };
  for (TomlTable& table : file.tables("wall")) {
    Wall wall = read_wall(table, motions, scene.materials, base_folder);
    refuse_equal_name(table, wall.name, scene.walls);
    scene.walls.push_back(std::move(wall));
    note_places(table);
  }
  for (TomlTable& table : file.tables("lifters")) {
    read_lifters(table, scene);
    note_places(table);
  }
}

}  // namespace workflows
