// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bitset>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/property/dem_gpu/exact/exact_overlap.h"

/// Convex solids cut by planes, in any of CGAL's number types (the includer brings the type, and CGAL::square and
/// CGAL::to_double with it).
namespace exact {

using dem_gpu::Vec3;

template <class Number>
struct Vector {
  Number x, y, z;
  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator*(const Number& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
};
template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Number>
Vector<Number> widened(const Vec3& v) {
  return {Number(v.x), Number(v.y), Number(v.z)};
}
template <class Number>
Vec3 rounded(const Vector<Number>& v) {
  return {CGAL::to_double(v.x), CGAL::to_double(v.y), CGAL::to_double(v.z)};
}

/// Inside where dot(normal, x) <= dot(normal, point); the normal has any length.
template <class Number>
struct HalfSpace {
  Vector<Number> normal, point;
};

using FaceSet = std::bitset<dem_gpu::kMaxPartFaces>;

template <class Number>
Number depth_below(const HalfSpace<Number>& plane, const Vector<Number>& x) {
  return dot(plane.normal, plane.point - x);
}

/// Where the line through two points meets a plane.
template <class Number>
Vector<Number> between(const Vector<Number>& from, const Vector<Number>& to, const HalfSpace<Number>& plane) {
  const Number depth = depth_below(plane, from);
  return from + (depth / (depth - depth_below(plane, to))) * (to - from);
}

template <class Number>
struct Solid {
  struct Face {
    std::vector<int> loop;  // counter-clockwise from outside
    bool is_of_a;
    int source;  // face of the body it comes from
  };
  std::vector<Vector<Number>> vertices;
  std::vector<FaceSet> faces_of_a;  // of each vertex: planes of a's faces that are known to pass through it
  std::vector<Face> faces;
};

/// A body with its edges and what meets in its vertices. Points of the overlap are computed from the bodies' own
/// vertices wherever they can be, so that intervals stay narrow however often a solid was cut.
template <class Number>
struct Mesh {
  Solid<Number> solid;
  std::vector<FaceSet> faces_of_vertex;
  std::map<std::pair<int, int>, std::pair<int, int>> edges;  // faces (low, high) to vertices

  explicit Mesh(Solid<Number> body) : solid(std::move(body)), faces_of_vertex(solid.vertices.size()) {
    std::map<std::pair<int, int>, int> left;  // of an edge from u to v
    for (const auto& face : solid.faces)
      for (std::size_t c = 0; c < face.loop.size(); ++c) {
        const int u = face.loop[c], v = face.loop[(c + 1) % face.loop.size()];
        faces_of_vertex[u].set(face.source);
        left[{u, v}] = face.source;
        if (const auto other = left.find({v, u}); other != left.end())
          edges[std::minmax(face.source, other->second)] = {u, v};
      }
  }
  /// Where three faces or more meet there is a vertex, and all others of its faces pass through it: decided by the
  /// mesh, not by arithmetic. -1 for none.
  int vertex_at(const FaceSet& faces) const {
    if (faces.count() < 3) return -1;
    for (std::size_t v = 0; v < faces_of_vertex.size(); ++v)
      if ((faces & faces_of_vertex[v]) == faces) return static_cast<int>(v);
    return -1;
  }
  HalfSpace<Number> plane(int face) const {
    const std::vector<int>& loop = solid.faces[face].loop;
    const Vector<Number>&p = solid.vertices[loop[0]], &q = solid.vertices[loop[1]], &r = solid.vertices[loop[2]];
    return {cross(q - p, r - p), p};
  }
  /// Where the edge of two faces meets a plane; nothing if the faces share no edge.
  std::optional<Vector<Number>> edge_in_plane(int face, int other_face, const HalfSpace<Number>& plane) const {
    const auto edge = edges.find(std::minmax(face, other_face));
    if (edge == edges.end()) return std::nullopt;
    return between(solid.vertices[edge->second.first], solid.vertices[edge->second.second], plane);
  }
};

template <class Number>
Number squared_norm(const dem_gpu::Quaternion& q) {
  return CGAL::square(Number(q.w)) + CGAL::square(Number(q.x)) + CGAL::square(Number(q.y)) + CGAL::square(Number(q.z));
}

/// The body relative to `origin`, in world axes, magnified by the squared norms of its own quaternion and of `other`:
/// without division rationals stay short.
template <class Number>
Solid<Number> placed(const Body& body, const Vec3& origin, const dem_gpu::Quaternion& other, bool is_a) {
  const dem_gpu::Quaternion& q = body.pose.orientation;
  const Number w(q.w), x(q.x), y(q.y), z(q.z);
  const Number factor = Number(body.pose.scale) * squared_norm<Number>(other);
  const Vector<Number> rows[3] = {
      {CGAL::square(w) + CGAL::square(x) - CGAL::square(y) - CGAL::square(z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
      {2 * (x * y + w * z), CGAL::square(w) - CGAL::square(x) + CGAL::square(y) - CGAL::square(z), 2 * (y * z - w * x)},
      {2 * (x * z - w * y), 2 * (y * z + w * x),
       CGAL::square(w) - CGAL::square(x) - CGAL::square(y) + CGAL::square(z)}};
  const Vector<Number> shift = squared_norm<Number>(q) * squared_norm<Number>(other) *
                               (widened<Number>(body.pose.position) - widened<Number>(origin));
  Solid<Number> solid;
  for (const catalog::Point& p : body.part.vertices) {
    const Vector<Number> v{Number(p[0]), Number(p[1]), Number(p[2])};
    solid.vertices.push_back(factor * Vector<Number>{dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)} + shift);
  }
  for (const catalog::ConvexFace& face : body.part.faces)
    solid.faces.push_back({face.vertices, is_a, static_cast<int>(solid.faces.size())});
  return solid;
}

/// Joins the cap's edges (from each corner to the next) to a loop.
inline std::vector<int> chained(const std::map<int, int>& next) {
  std::vector<int> loop{next.begin()->first};
  for (int corner = next.begin()->second; corner != loop[0]; corner = next.at(corner)) {
    if (loop.size() > next.size()) throw std::logic_error("exact overlap: the cut is no single polygon");
    loop.push_back(corner);
  }
  if (loop.size() != next.size()) throw std::logic_error("exact overlap: the cut is no single polygon");
  return loop;
}

/// Cuts the overlap so far by the plane of a face of a; the cut becomes a face of a. A face in the plane itself stays
/// as it is.
template <class Number>
void clip(Solid<Number>& solid, const Mesh<Number>& a, const Mesh<Number>& b, int source) {
  const HalfSpace<Number> half_space = a.plane(source);
  const std::size_t count = solid.vertices.size();
  std::vector<int> side;
  for (std::size_t v = 0; v < count; ++v) {
    FaceSet& faces = solid.faces_of_a[v];
    const int vertex_of_a = a.vertex_at(faces);
    const bool is_in_face = vertex_of_a >= 0 && a.faces_of_vertex[vertex_of_a].test(source);
    side.push_back(is_in_face ? 0 : static_cast<CGAL::Sign>(CGAL::sign(depth_below(half_space, solid.vertices[v]))));
    if (side.back() == 0) faces.set(source);
  }
  if (std::none_of(side.begin(), side.end(), [](int s) { return s < 0; })) return;
  if (std::none_of(side.begin(), side.end(), [](int s) { return s > 0; })) {
    solid = {};
    return;
  }
  std::map<std::pair<int, int>, int> left;  // face left of an edge from u to v
  for (std::size_t f = 0; f < solid.faces.size(); ++f)
    for (std::size_t c = 0; c < solid.faces[f].loop.size(); ++c)
      left[{solid.faces[f].loop[c], solid.faces[f].loop[(c + 1) % solid.faces[f].loop.size()]}] = static_cast<int>(f);
  const auto crossing = [&](int u, int v, const FaceSet& faces) {
    if (const int vertex = a.vertex_at(faces); vertex >= 0) return a.solid.vertices[vertex];
    const auto &one = solid.faces[left.at({u, v})], &two = solid.faces[left.at({v, u})];
    std::optional<Vector<Number>> point;
    if (!one.is_of_a && !two.is_of_a) point = b.edge_in_plane(one.source, two.source, half_space);
    if (one.is_of_a && !two.is_of_a) point = a.edge_in_plane(one.source, source, b.plane(two.source));
    if (two.is_of_a && !one.is_of_a) point = a.edge_in_plane(two.source, source, b.plane(one.source));
    return point ? *point : between(solid.vertices[u], solid.vertices[v], half_space);
  };
  std::map<std::pair<int, int>, int> cuts;  // of an edge (low, high)
  const auto cut = [&](int u, int v) {
    const auto [found, is_new] = cuts.try_emplace(std::minmax(u, v), static_cast<int>(solid.vertices.size()));
    if (is_new) {
      FaceSet faces = solid.faces_of_a[u] & solid.faces_of_a[v];
      faces.set(source);
      solid.vertices.push_back(crossing(u, v, faces));
      solid.faces_of_a.push_back(faces);
    }
    return found->second;
  };
  const auto is_on_plane = [&](int v) { return v >= static_cast<int>(count) || side[v] == 0; };
  Solid<Number> result;
  std::map<int, int> cap;
  for (const auto& face : solid.faces) {
    std::vector<int> loop;
    bool has_inside = false, lies_in_plane = true;
    for (std::size_t c = 0; c < face.loop.size(); ++c) {
      const int u = face.loop[c], v = face.loop[(c + 1) % face.loop.size()];
      has_inside |= side[u] > 0;
      lies_in_plane &= side[u] == 0;
      if (side[u] >= 0) loop.push_back(u);
      if (side[u] * side[v] < 0) loop.push_back(cut(u, v));
    }
    if (!has_inside && !lies_in_plane) continue;
    if (!lies_in_plane)
      for (std::size_t c = 0; c < loop.size(); ++c) {
        const int u = loop[c], v = loop[(c + 1) % loop.size()];
        if (is_on_plane(u) && is_on_plane(v)) cap[v] = u;
      }
    result.faces.push_back({std::move(loop), face.is_of_a, face.source});
  }
  result.faces.push_back({chained(cap), true, source});
  // Only vertices in use go on.
  std::vector<int> renamed(solid.vertices.size(), -1);
  for (auto& face : result.faces)
    for (int& v : face.loop) {
      if (renamed[v] < 0) {
        renamed[v] = static_cast<int>(result.vertices.size());
        result.vertices.push_back(solid.vertices[v]);
        result.faces_of_a.push_back(solid.faces_of_a[v]);
      }
      v = renamed[v];
    }
  solid = std::move(result);
}

}  // namespace exact
