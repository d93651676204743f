// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/shapes/shape_columns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem_gpu/shapes/depth_field.h"

namespace dem_gpu {
namespace {

using catalog::ConvexFace;
using catalog::ConvexPart;
using catalog::FaceKind;

Vec3 to_vec3(const catalog::Point& p) { return {p[0], p[1], p[2]}; }

LocalHalfSpace to_half_space(const ConvexFace& face) {
  return rounded(HalfSpace{to_vec3(face.plane.normal), face.plane.offset});
}

void append(std::vector<LocalHalfSpace>& planes, const std::vector<HalfSpace>& more) {
  for (const HalfSpace& plane : more) planes.push_back(rounded(plane));
}

/// Cuts a face of many corners by diagonals from its first.
void append_pieces(HostShapeColumns& columns, FaceCorners& face) {
  face.first_piece = static_cast<int>(columns.face_pieces.size());
  const std::uint8_t* corner = columns.corners.data() + face.first;
  int next = 1;  // corner after the last piece's diagonal
  do {
    FacePiece piece;
    std::fill(std::begin(piece.corner.lane), std::end(piece.corner.lane), corner[0]);
    piece.count = 1;
    for (int c = next; c < face.count && piece.count < kLanes; ++c) piece.corner.lane[piece.count++] = corner[c];
    next += piece.count - 2;
    columns.face_pieces.push_back(piece);
  } while (next + 1 < face.count);
  face.piece_count = static_cast<int>(columns.face_pieces.size()) - face.first_piece;
}

void append_vertex_blocks(HostShapeColumns& columns, PartRange& part) {
  part.first_vertex_block = static_cast<int>(columns.vertex_blocks.size());
  for (int first = 0; first < part.vertex_count; first += kLanes) {
    VertexBlock block;
    for (int lane = 0; lane < kLanes; ++lane) {
      const int v = part.first_vertex + std::min(first + lane, part.vertex_count - 1);
      const LocalVec3& vertex = columns.vertices[static_cast<std::size_t>(v)];
      block.x[lane] = vertex.x, block.y[lane] = vertex.y, block.z[lane] = vertex.z;
    }
    columns.vertex_blocks.push_back(block);
  }
}

/// Faces in one plane have its first face's number. The tolerance is far above rounding, far below any real step.
void find_shared_planes(HostShapeColumns& columns, const PartRange& part) {
  constexpr Real kTolerance = local_tolerance(1e-9, 1e-5);
  const auto lies_in = [&](const FaceCorners& face, const HalfSpace& plane) {
    for (int c = face.first; c < face.first + face.count; ++c) {
      const int v = part.first_vertex + columns.corners[static_cast<std::size_t>(c)];
      if (std::abs(depth_below<Real>(plane, columns.vertices[static_cast<std::size_t>(v)])) > kTolerance * part.radius)
        return false;
    }
    return true;
  };
  for (int f = 0; f < part.face_count; ++f) {
    const auto row = [&](int face) { return static_cast<std::size_t>(part.first_face + face); };
    columns.faces[row(f)].plane = f;
    const HalfSpace own = columns.planes[row(f)];
    for (int g = f - 1; g >= 0; --g) {
      const HalfSpace other = columns.planes[row(g)];
      if (dot(own.normal, other.normal) > 0 && lies_in(columns.faces[row(f)], other))
        columns.faces[row(f)].plane = columns.faces[row(g)].plane;
    }
  }
}

PartRange append_part(HostShapeColumns& columns, const ConvexPart& part) {
  PartRange range;
  range.first_vertex = static_cast<int>(columns.vertices.size());
  range.vertex_count = static_cast<int>(part.vertices.size());
  range.first_face = static_cast<int>(columns.planes.size());
  range.face_count = static_cast<int>(part.faces.size());
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const catalog::Point& point : part.vertices) {
    columns.vertices.push_back(rounded(to_vec3(point)));
    const Vec3 vertex = columns.vertices.back();
    low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y), std::min(low.z, vertex.z)};
    high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y), std::max(high.z, vertex.z)};
  }
  append_vertex_blocks(columns, range);
  range.centre = Real(0.5) * (low + high);
  for (auto vertex = columns.vertices.begin() + range.first_vertex; vertex != columns.vertices.end(); ++vertex)
    range.radius = std::max(range.radius, norm(Vec3(*vertex) - range.centre));
  for (const FaceKind kind : {FaceKind::outer, FaceKind::inner})
    for (const ConvexFace& face : part.faces) {
      if (face.kind != kind) continue;
      columns.planes.push_back(to_half_space(face));
      FaceCorners corners{static_cast<int>(columns.corners.size()), static_cast<int>(face.vertices.size())};
      for (const int vertex : face.vertices) {
        columns.corners.push_back(static_cast<std::uint8_t>(vertex));
        corners.vertices |= std::uint64_t{1} << vertex;
      }
      append_pieces(columns, corners);
      columns.faces.push_back(corners);
      if (kind == FaceKind::outer) ++range.outer_face_count;
    }
  find_shared_planes(columns, range);
  return range;
}

void append_depth_field(HostShapeColumns& columns, const PartDepthField& field, Real cap, PartRange& part) {
  part.first_depth_plane = static_cast<int>(columns.depth_planes.size());
  append(columns.depth_planes, field.planes);
  columns.depth_planes.push_back(rounded(HalfSpace{{0, 0, 0}, cap}));
  part.depth_plane_count = static_cast<int>(columns.depth_planes.size()) - part.first_depth_plane;
  part.first_depth_term = static_cast<int>(columns.depth_terms.size());
  part.depth_term_count = static_cast<int>(field.greatest.size());
  for (const GreatestDepth& term : field.greatest) {
    columns.depth_terms.push_back({static_cast<int>(columns.term_planes.size()), static_cast<int>(term.size())});
    append(columns.term_planes, term);
  }
}

void append_polyhedron(HostShapeColumns& columns, const PolyhedralShape& polyhedron, ShapeRange& range,
                       std::optional<Real> depth_cap) {
  range.first_part = static_cast<int>(columns.parts.size());
  range.part_count = static_cast<int>(polyhedron.parts.size());
  for (const ConvexPart& part : polyhedron.parts) {
    columns.parts.push_back(append_part(columns, part));
    for (const catalog::Point& vertex : part.vertices)
      range.bounding_radius = std::max(range.bounding_radius, norm(to_vec3(vertex)));
  }
  if (!depth_cap) return;
  const Real cap = *depth_cap * range.equivalent_diameter;
  const std::vector<PartDepthField> fields = part_depth_fields(polyhedron.parts, range.equivalent_diameter, cap);
  for (std::size_t p = 0; p < fields.size(); ++p)
    append_depth_field(columns, fields[p], cap, columns.parts[static_cast<std::size_t>(range.first_part) + p]);
}

/// Appends `count` entries from `first` on, and returns where they are.
template <class Entry>
int copy_entries(const std::vector<Entry>& from, int first, int count, std::vector<Entry>& to) {
  const int place = static_cast<int>(to.size());
  to.insert(to.end(), from.begin() + first, from.begin() + first + count);
  return place;
}

void copy_part(const HostShapeColumns& from, PartRange part, HostShapeColumns& to) {
  part.first_vertex = copy_entries(from.vertices, part.first_vertex, part.vertex_count, to.vertices);
  part.first_vertex_block = copy_entries(from.vertex_blocks, part.first_vertex_block,
                                         (part.vertex_count + kLanes - 1) / kLanes, to.vertex_blocks);
  copy_entries(from.planes, part.first_face, part.face_count, to.planes);
  part.first_face = copy_entries(from.faces, part.first_face, part.face_count, to.faces);
  for (int f = part.first_face; f < part.first_face + part.face_count; ++f) {
    FaceCorners& face = to.faces[static_cast<std::size_t>(f)];
    face.first = copy_entries(from.corners, face.first, face.count, to.corners);
    face.first_piece = copy_entries(from.face_pieces, face.first_piece, face.piece_count, to.face_pieces);
  }
  part.first_depth_plane =
      copy_entries(from.depth_planes, part.first_depth_plane, part.depth_plane_count, to.depth_planes);
  part.first_depth_term = copy_entries(from.depth_terms, part.first_depth_term, part.depth_term_count, to.depth_terms);
  for (int t = part.first_depth_term; t < part.first_depth_term + part.depth_term_count; ++t) {
    DepthTerm& term = to.depth_terms[static_cast<std::size_t>(t)];
    term.first = copy_entries(from.term_planes, term.first, term.count, to.term_planes);
  }
  to.parts.push_back(part);
}

}  // namespace

HostShapeColumns make_host_shape_columns(const std::vector<Shape>& shapes, std::optional<Real> depth_cap) {
  HostShapeColumns columns;
  for (const Shape& shape : shapes) {
    ShapeRange range;
    range.volume = shape.volume;
    range.inertia = shape.principal_inertia;
    range.equivalent_diameter = std::cbrt(6 * shape.volume / std::numbers::pi);
    if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry))
      range.sphere_radius = range.bounding_radius = sphere->radius;
    else
      append_polyhedron(columns, std::get<PolyhedralShape>(shape.geometry), range, depth_cap);
    columns.shapes.push_back(range);
  }
  return columns;
}

ShapeColumns make_shape_columns(const std::vector<Shape>& shapes, std::optional<Real> depth_cap) {
  return to_device(make_host_shape_columns(shapes, depth_cap));
}

ShapeColumns to_device(const HostShapeColumns& host) {
  ShapeColumns columns;
  assign(columns.shapes, host.shapes);
  assign(columns.parts, host.parts);
  assign(columns.vertices, host.vertices);
  assign(columns.planes, host.planes);
  assign(columns.faces, host.faces);
  assign(columns.corners, host.corners);
  assign(columns.face_pieces, host.face_pieces);
  assign(columns.vertex_blocks, host.vertex_blocks);
  assign(columns.depth_planes, host.depth_planes);
  assign(columns.depth_terms, host.depth_terms);
  assign(columns.term_planes, host.term_planes);
  return columns;
}

HostShapeColumns to_host(const ShapeColumns& columns) {
  return {to_host(columns.shapes),      to_host(columns.parts),         to_host(columns.vertices),
          to_host(columns.planes),      to_host(columns.faces),         to_host(columns.corners),
          to_host(columns.face_pieces), to_host(columns.vertex_blocks), to_host(columns.depth_planes),
          to_host(columns.depth_terms), to_host(columns.term_planes)};
}

HostShapeColumns chosen_shapes(const HostShapeColumns& columns, const std::vector<int>& rows) {
  HostShapeColumns chosen;
  for (const int row : rows) {
    ShapeRange range = columns.shapes[static_cast<std::size_t>(row)];
    const int first = range.first_part;
    if (range.part_count > 0) range.first_part = static_cast<int>(chosen.parts.size());
    for (int p = first; p < first + range.part_count; ++p)
      copy_part(columns, columns.parts[static_cast<std::size_t>(p)], chosen);
    chosen.shapes.push_back(range);
  }
  return chosen;
}

ShapeView view(const ShapeColumns& columns) {
  return {pointer(columns.shapes),      pointer(columns.parts),         pointer(columns.vertices),
          pointer(columns.planes),      pointer(columns.faces),         pointer(columns.corners),
          pointer(columns.face_pieces), pointer(columns.vertex_blocks), pointer(columns.depth_planes),
          pointer(columns.depth_terms), pointer(columns.term_planes)};
}

ShapeView view(const HostShapeColumns& columns) {
  return {columns.shapes.data(),      columns.parts.data(),         columns.vertices.data(),
          columns.planes.data(),      columns.faces.data(),         columns.corners.data(),
          columns.face_pieces.data(), columns.vertex_blocks.data(), columns.depth_planes.data(),
          columns.depth_terms.data(), columns.term_planes.data()};
}

}  // namespace dem_gpu
