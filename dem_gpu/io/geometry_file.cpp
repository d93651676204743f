// SPDX-License-Identifier: Apache-2.0
#include <span>
#include <string>

#include "dem_gpu/io/columns.h"
#include "dem_gpu/io/hdf5_file.h"
#include "dem_gpu/snapshot.h"

namespace dem_gpu {
namespace {

constexpr const char* kKind = "geometry";
constexpr int kVersion = 2;

/// All convex parts of the file in one flat table: offsets of part p run from [p] to [p + 1].
struct PartTable {
  std::vector<std::int32_t> vertex_offset{0};  // n_parts + 1
  std::vector<std::int32_t> face_offset{0};    // n_parts + 1
  std::vector<double> vertices;                // n_vertices x 3 [m]
  std::vector<std::int32_t> corner_offset{0};  // n_faces + 1
  std::vector<std::int32_t> corners;           // vertex of its part
  std::vector<double> planes;                  // n_faces x 4: unit normal, offset [m]
  std::vector<std::uint8_t> kinds;             // n_faces: 0 outer, 1 inner

  int part_count() const { return static_cast<int>(vertex_offset.size()) - 1; }

  /// Index of the part added.
  int add(const catalog::ConvexPart& part) {
    for (const catalog::Point& vertex : part.vertices) vertices.insert(vertices.end(), vertex.begin(), vertex.end());
    for (const catalog::ConvexFace& face : part.faces) {
      corners.insert(corners.end(), face.vertices.begin(), face.vertices.end());
      corner_offset.push_back(static_cast<std::int32_t>(corners.size()));
      planes.insert(planes.end(), face.plane.normal.begin(), face.plane.normal.end());
      planes.push_back(face.plane.offset);
      kinds.push_back(face.kind == catalog::FaceKind::inner ? 1 : 0);
    }
    vertex_offset.push_back(static_cast<std::int32_t>(vertices.size() / 3));
    face_offset.push_back(static_cast<std::int32_t>(kinds.size()));
    return part_count() - 1;
  }

  catalog::ConvexPart part(int index) const {
    catalog::ConvexPart part;
    for (int v = vertex_offset[index]; v < vertex_offset[index + 1]; ++v)
      part.vertices.push_back({vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]});
    for (int f = face_offset[index]; f < face_offset[index + 1]; ++f) {
      catalog::ConvexFace face;
      face.vertices.assign(corners.begin() + corner_offset[f], corners.begin() + corner_offset[f + 1]);
      face.plane = {{planes[4 * f], planes[4 * f + 1], planes[4 * f + 2]}, planes[4 * f + 3]};
      face.kind = kinds[f] != 0 ? catalog::FaceKind::inner : catalog::FaceKind::outer;
      part.faces.push_back(std::move(face));
    }
    return part;
  }
};

/// Offsets must start at 0, never fall, and end at `end`.
void check_offsets(const io::Hdf5Reader& file, const std::string& name, std::span<const std::int32_t> offsets,
                   std::size_t end) {
  bool is_right = !offsets.empty() && offsets.front() == 0 && offsets.back() == static_cast<std::int64_t>(end);
  for (std::size_t i = 1; i < offsets.size(); ++i) is_right = is_right && offsets[i - 1] <= offsets[i];
  if (!is_right) file.refuse("dataset " + name, "offsets do not partition the table they point into");
}

/// Indices must lie in [low, high).
void check_indices(const io::Hdf5Reader& file, const std::string& name, std::span<const std::int32_t> indices, int low,
                   int high) {
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (indices[i] < low || indices[i] >= high)
      file.refuse("dataset " + name + " row " + std::to_string(i), "index " + std::to_string(indices[i]) +
                                                                       " is outside " + std::to_string(low) + " .. " +
                                                                       std::to_string(high - 1));
}

void write_parts(io::Hdf5Writer& file, const PartTable& table) {
  file.write("parts/vertex_offset", table.vertex_offset);
  file.write("parts/face_offset", table.face_offset);
  file.write("parts/vertices", table.vertices, 3);
  file.write("parts/corner_offset", table.corner_offset);
  file.write("parts/corners", table.corners);
  file.write("parts/planes", table.planes, 4);
  file.write("parts/face_kind", table.kinds);
}

PartTable read_parts(const io::Hdf5Reader& file) {
  PartTable table;
  table.vertex_offset = file.read<std::int32_t>("parts/vertex_offset");
  table.vertices = file.read<double>("parts/vertices", 3);
  table.kinds = file.read<std::uint8_t>("parts/face_kind");
  const std::size_t faces = table.kinds.size();
  table.face_offset = file.read<std::int32_t>("parts/face_offset", io::ArrayShape{table.vertex_offset.size(), 1});
  table.corners = file.read<std::int32_t>("parts/corners");
  table.corner_offset = file.read<std::int32_t>("parts/corner_offset", io::ArrayShape{faces + 1, 1});
  table.planes = file.read<double>("parts/planes", io::ArrayShape{faces, 4});
  check_offsets(file, "parts/vertex_offset", table.vertex_offset, table.vertices.size() / 3);
  check_offsets(file, "parts/face_offset", table.face_offset, faces);
  check_offsets(file, "parts/corner_offset", table.corner_offset, table.corners.size());
  for (int p = 0; p < table.part_count(); ++p) {
    const int first = table.corner_offset[table.face_offset[p]], last = table.corner_offset[table.face_offset[p + 1]];
    check_indices(file, "parts/corners", std::span(table.corners).subspan(first, last - first), 0,
                  table.vertex_offset[p + 1] - table.vertex_offset[p]);
  }
  return table;
}

void write_shapes(io::Hdf5Writer& file, const std::vector<ShapeGeometry>& shapes, PartTable& parts) {
  std::vector<std::string> names;
  std::vector<double> radii, volumes;
  std::vector<std::int32_t> part_offset{0};
  for (const ShapeGeometry& shape : shapes) {
    names.push_back(shape.name);
    radii.push_back(shape.sphere_radius);
    volumes.push_back(shape.volume);
    for (const catalog::ConvexPart& part : shape.parts) parts.add(part);
    part_offset.push_back(parts.part_count());
  }
  file.write_strings("shapes/name", names);
  file.write("shapes/sphere_radius", radii);
  file.write("shapes/volume", volumes);
  file.write("shapes/part_offset", part_offset);
}

std::vector<ShapeGeometry> read_shapes(const io::Hdf5Reader& file, const PartTable& parts) {
  const std::vector<std::string> names = file.read_strings("shapes/name");
  const std::vector<double> radii = file.read<double>("shapes/sphere_radius", io::ArrayShape{names.size(), 1});
  const std::vector<double> volumes = file.read<double>("shapes/volume", io::ArrayShape{names.size(), 1});
  const auto part_offset = file.read<std::int32_t>("shapes/part_offset", io::ArrayShape{names.size() + 1, 1});
  check_indices(file, "shapes/part_offset", part_offset, 0, parts.part_count() + 1);
  check_offsets(file, "shapes/part_offset", part_offset, static_cast<std::size_t>(part_offset.back()));
  std::vector<ShapeGeometry> shapes(names.size());
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    shapes[s].name = names[s];
    shapes[s].sphere_radius = radii[s];
    shapes[s].volume = volumes[s];
    for (int p = part_offset[s]; p < part_offset[s + 1]; ++p) shapes[s].parts.push_back(parts.part(p));
  }
  return shapes;
}

/// Meshes of all walls end to end; wall w has vertices and faces [w] to [w + 1] of the offsets.
void write_meshes(io::Hdf5Writer& file, const std::vector<WallGeometry>& walls) {
  std::vector<std::int32_t> vertex_offset{0}, face_offset{0}, faces;
  std::vector<double> vertices;
  for (const WallGeometry& wall : walls) {
    for (const catalog::Point& vertex : wall.mesh.vertices)
      vertices.insert(vertices.end(), vertex.begin(), vertex.end());
    for (const catalog::Triangle& face : wall.mesh.faces) faces.insert(faces.end(), face.begin(), face.end());
    vertex_offset.push_back(static_cast<std::int32_t>(vertices.size() / 3));
    face_offset.push_back(static_cast<std::int32_t>(faces.size() / 3));
  }
  file.write("walls/mesh_vertex_offset", vertex_offset);
  file.write("walls/mesh_vertices", vertices, 3);
  file.write("walls/mesh_face_offset", face_offset);
  file.write("walls/mesh_faces", faces, 3);
}

void read_meshes(const io::Hdf5Reader& file, std::vector<WallGeometry>& walls) {
  const io::ArrayShape offsets{walls.size() + 1, 1};
  const auto vertex_offset = file.read<std::int32_t>("walls/mesh_vertex_offset", offsets);
  const auto face_offset = file.read<std::int32_t>("walls/mesh_face_offset", offsets);
  const auto vertices = file.read<double>("walls/mesh_vertices", 3);
  const auto faces = file.read<std::int32_t>("walls/mesh_faces", 3);
  check_offsets(file, "walls/mesh_vertex_offset", vertex_offset, vertices.size() / 3);
  check_offsets(file, "walls/mesh_face_offset", face_offset, faces.size() / 3);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    catalog::TriangleMesh& mesh = walls[w].mesh;
    for (int v = vertex_offset[w]; v < vertex_offset[w + 1]; ++v)
      mesh.vertices.push_back({vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]});
    const int first = face_offset[w], last = face_offset[w + 1];
    check_indices(file, "walls/mesh_faces", std::span(faces).subspan(3 * first, 3 * (last - first)), 0,
                  static_cast<int>(mesh.vertices.size()));
    for (int f = first; f < last; ++f) mesh.faces.push_back({faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]});
  }
}

void write_walls(io::Hdf5Writer& file, const std::vector<WallGeometry>& walls, PartTable& parts) {
  std::vector<std::string> names, classes;
  std::vector<std::int32_t> kinds, part_index;
  std::vector<Vec3> points, directions;
  std::vector<double> sizes;
  for (const WallGeometry& wall : walls) {
    names.push_back(wall.name);
    classes.push_back(wall.contact_class);
    kinds.push_back(static_cast<std::int32_t>(wall.kind));
    points.push_back(wall.point);
    directions.push_back(wall.direction);
    sizes.insert(sizes.end(), {wall.length, wall.base_radius, wall.top_radius});
    part_index.push_back(wall.kind == WallKind::volume_object ? parts.add(wall.part) : -1);
  }
  file.write_strings("walls/name", names);
  file.write_strings("walls/contact_class", classes);
  file.write("walls/kind", kinds);
  file.write("walls/point", io::rows_of(points), 3);
  file.write("walls/direction", io::rows_of(directions), 3);
  file.write("walls/length_radii", sizes, 3);
  file.write("walls/part", part_index);
  write_meshes(file, walls);
}

std::vector<WallGeometry> read_walls(const io::Hdf5Reader& file, const PartTable& parts) {
  const std::vector<std::string> names = file.read_strings("walls/name");
  const std::size_t count = names.size();
  const std::vector<std::string> classes = file.read_strings("walls/contact_class");
  if (classes.size() != count) file.refuse("dataset walls/contact_class", "expected one row a wall");
  const auto kinds = file.read<std::int32_t>("walls/kind", io::ArrayShape{count, 1});
  const auto points = io::vectors_of(file.read<double>("walls/point", io::ArrayShape{count, 3}));
  const auto directions = io::vectors_of(file.read<double>("walls/direction", io::ArrayShape{count, 3}));
  const auto sizes = file.read<double>("walls/length_radii", io::ArrayShape{count, 3});
  const auto part_index = file.read<std::int32_t>("walls/part", io::ArrayShape{count, 1});
  check_indices(file, "walls/kind", kinds, 0, static_cast<int>(WallKind::sphere) + 1);
  check_indices(file, "walls/part", part_index, -1, parts.part_count());
  std::vector<WallGeometry> walls(count);
  for (std::size_t w = 0; w < count; ++w) {
    walls[w].name = names[w];
    walls[w].contact_class = classes[w];
    walls[w].kind = static_cast<WallKind>(kinds[w]);
    walls[w].point = points[w];
    walls[w].direction = directions[w];
    walls[w].length = sizes[3 * w];
    walls[w].base_radius = sizes[3 * w + 1];
    walls[w].top_radius = sizes[3 * w + 2];
    if (part_index[w] >= 0) walls[w].part = parts.part(part_index[w]);
  }
  read_meshes(file, walls);
  return walls;
}

}  // namespace

void write_geometry(const std::filesystem::path& path, const RunGeometry& geometry) {
  io::Hdf5Writer file(path, kKind, kVersion);
  PartTable parts;
  write_shapes(file, geometry.shapes, parts);
  write_walls(file, geometry.walls, parts);
  write_parts(file, parts);
  file.write_strings("materials/name", geometry.materials);
  file.write("materials/density", geometry.material_density);
  file.write("bodies/shape", std::vector<std::int32_t>(geometry.body_shape.begin(), geometry.body_shape.end()));
  file.write("bodies/material",
             std::vector<std::int32_t>(geometry.body_material.begin(), geometry.body_material.end()));
  file.write("bodies/scale", geometry.body_scale);
  file.write("bodies/mass", geometry.body_mass);
  file.commit();
}

RunGeometry read_geometry(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path, kKind, kVersion);
  const PartTable parts = read_parts(file);
  RunGeometry geometry;
  geometry.shapes = read_shapes(file, parts);
  geometry.walls = read_walls(file, parts);
  geometry.materials = file.read_strings("materials/name");
  geometry.material_density = file.read<double>("materials/density", io::ArrayShape{geometry.materials.size(), 1});
  const auto shape = file.read<std::int32_t>("bodies/shape");
  const io::ArrayShape column{shape.size(), 1};
  const auto material = file.read<std::int32_t>("bodies/material", column);
  check_indices(file, "bodies/shape", shape, 0, static_cast<int>(geometry.shapes.size()));
  check_indices(file, "bodies/material", material, 0, static_cast<int>(geometry.materials.size()));
  geometry.body_shape.assign(shape.begin(), shape.end());
  geometry.body_material.assign(material.begin(), material.end());
  geometry.body_scale = file.read<double>("bodies/scale", column);
  geometry.body_mass = file.read<double>("bodies/mass", column);
  return geometry;
}

}  // namespace dem_gpu
