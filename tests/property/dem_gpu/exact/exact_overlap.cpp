// SPDX-License-Identifier: Apache-2.0
#include "tests/property/dem_gpu/exact/exact_overlap.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Lazy_exact_nt.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <vector>

namespace exact {
namespace {

using dem_gpu::Vec3;
/// Its rounding mode is set once, in overlap().
using Interval = CGAL::Interval_nt_advanced;
using Lazy = CGAL::Lazy_exact_nt<CGAL::Exact_rational>;

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
std::vector<int> chained(const std::map<int, int>& next) {
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

bool has_equal_normal(const Vec3& a, const Vec3& b) { return dot(a, b) > 0.9 * norm(a) * norm(b); }

/// All corners of a body's face within `tolerance` of a plane. (Conversions to double lose far less than that.)
template <class Number>
bool lies_in(const Mesh<Number>& body, int face, const HalfSpace<Number>& plane, double tolerance) {
  const double limit = tolerance * norm(rounded(plane.normal));
  const std::vector<int>& loop = body.solid.faces[face].loop;
  return std::all_of(loop.begin(), loop.end(), [&](int v) {
    return std::abs(CGAL::to_double(depth_below(plane, body.solid.vertices[v]))) <= limit;
  });
}

/// What a facet of the overlap inherits from the face it comes from: the normal, and whether that face is flush with
/// one of the other body.
template <class Number>
class BodyFaces {
 public:
  BodyFaces(const Mesh<Number>& a, const Mesh<Number>& b, double tolerance)
      : normals_a_(normals(a)), normals_b_(normals(b)), of_a_(normals_a_.size()), of_b_(normals_b_.size()) {
    for (std::size_t i = 0; i < normals_a_.size(); ++i)
      for (std::size_t j = 0; j < normals_b_.size(); ++j) {
        const int face_a = static_cast<int>(i), face_b = static_cast<int>(j);
        if (has_equal_normal(normals_a_[i], normals_b_[j]) &&
            (lies_in(a, face_a, b.plane(face_b), tolerance) || lies_in(b, face_b, a.plane(face_a), tolerance)))
          of_a_[i] = of_b_[j] = true;
      }
  }
  bool is_flush(const typename Solid<Number>::Face& face) const {
    return face.is_of_a ? of_a_[face.source] : of_b_[face.source];
  }
  const Vec3& normal(const typename Solid<Number>::Face& face) const {
    return face.is_of_a ? normals_a_[face.source] : normals_b_[face.source];
  }

 private:
  static std::vector<Vec3> normals(const Mesh<Number>& mesh) {
    std::vector<Vec3> all;
    for (const auto& face : mesh.solid.faces) all.push_back(rounded(mesh.plane(face.source).normal));
    return all;
  }
  std::vector<Vec3> normals_a_, normals_b_;
  std::vector<bool> of_a_, of_b_;
};

/// V, S, M before rounding.
template <class Number>
struct Integrals {
  Number volume{0};                                    // 6 V until scaled
  Vector<Number> area{0, 0, 0}, area_moment{0, 0, 0};  // 2 S, 6 M until scaled

  void scale(const Number& magnification) {
    const Number square = CGAL::square(magnification), cube = square * magnification;
    volume = volume / (6 * cube);
    area = (1 / (2 * square)) * area;
    area_moment = (1 / (6 * cube)) * area_moment;
  }
};

double sine_between(const Vec3& a, const Vec3& b) { return norm(cross(a, b)) / (norm(a) * norm(b)); }

/// Adds surface and seam, in double: they only scale errors.
template <class Number>
void measure(const Solid<Number>& solid, const BodyFaces<Number>& bodies, Overlap& overlap) {
  struct Side {
    bool is_of_a;
    Vec3 normal;
  };
  std::map<std::pair<int, int>, Side> sides;
  std::vector<Vec3> vertices;  // about the first, so that the smallest overlaps keep their digits
  for (const Vector<Number>& vertex : solid.vertices) vertices.push_back(rounded(vertex - solid.vertices[0]));
  for (const auto& face : solid.faces) {
    const bool is_flush = bodies.is_flush(face), is_of_a = face.is_of_a && !is_flush;
    Vec3 twice;
    const Vec3 first = vertices[face.loop[0]];
    for (std::size_t c = 2; c < face.loop.size(); ++c)
      twice += cross(vertices[face.loop[c - 1]] - first, vertices[face.loop[c]] - first);
    overlap.surface += norm(twice) / 2;
    if (is_flush) overlap.flush_area += 0.5 * twice;
    for (std::size_t c = 0; c < face.loop.size(); ++c) {
      const int u = face.loop[c], v = face.loop[(c + 1) % face.loop.size()];
      const Vec3 normal = bodies.normal(face);
      const auto [other, is_new] = sides.try_emplace(std::minmax(u, v), Side{is_of_a, normal});
      if (is_new || other->second.is_of_a == is_of_a) continue;
      const double length = norm(vertices[u] - vertices[v]);
      const double sine = sine_between(other->second.normal, normal);
      if (length > 0) overlap.seam += sine > 0 ? length / sine : HUGE_VAL;
    }
  }
}

template <class Number>
Integrals<Number> integrate(const Solid<Number>& solid, const BodyFaces<Number>& bodies) {
  Integrals<Number> sum;
  for (const auto& face : solid.faces) {
    const bool is_of_a = face.is_of_a && !bodies.is_flush(face);
    const Vector<Number>& p = solid.vertices[face.loop[0]];
    for (std::size_t c = 2; c < face.loop.size(); ++c) {
      const Vector<Number>&q = solid.vertices[face.loop[c - 1]], &r = solid.vertices[face.loop[c]];
      const Vector<Number> twice = cross(q - p, r - p);
      sum.volume = sum.volume + dot(p - solid.vertices[0], twice);
      if (!is_of_a) continue;
      sum.area = sum.area + twice;
      sum.area_moment = sum.area_moment + cross(p + q + r, twice);
    }
  }
  return sum;
}

double width(const Interval& x) { return x.sup() - x.inf(); }
double width(const Vector<Interval>& v) { return std::max({width(v.x), width(v.y), width(v.z)}); }

void settle(const Lazy& x) { x.exact(); }
void settle(const Vector<Lazy>& v) { settle(v.x), settle(v.y), settle(v.z); }

/// Intervals of this width over the results' scales are good enough: their middle is then within a fifth of the error
/// that the tests look for.
constexpr double kNarrow = 4e-11;

double size_of(const Body& body) {
  double largest = 0;
  for (const catalog::Point& p : body.part.vertices) largest = std::max(largest, norm(Vec3{p[0], p[1], p[2]}));
  return body.pose.scale * largest;
}

bool is_narrow(const Integrals<Interval>& sum, const Overlap& overlap, double size) {
  const double area = kNarrow * overlap.area_scale(size);
  return width(sum.volume) <= kNarrow * overlap.volume_scale(size) && width(sum.area) <= area &&
         width(sum.area_moment) <= area * size;
}

template <class Number>
std::optional<Overlap> overlap_in(const Body& a, const Body& b, double flush_tolerance) {
  const Mesh<Number> mesh_a(placed<Number>(a, a.pose.position, b.pose.orientation, true));
  const Mesh<Number> mesh_b(placed<Number>(b, a.pose.position, a.pose.orientation, false));
  Solid<Number> common = mesh_b.solid;
  common.faces_of_a.resize(common.vertices.size());
  for (const auto& face : mesh_a.solid.faces) {
    clip(common, mesh_a, mesh_b, face.source);
    if (common.faces.empty()) return Overlap{};
  }
  const BodyFaces<Number> bodies(mesh_a, mesh_b, flush_tolerance);
  Overlap result;
  Integrals<Number> sum = integrate(common, bodies);
  sum.scale(squared_norm<Number>(a.pose.orientation) * squared_norm<Number>(b.pose.orientation));
  constexpr bool kIsExact = std::is_same_v<Number, Lazy>;
  if constexpr (kIsExact) settle(sum.volume), settle(sum.area), settle(sum.area_moment);
  measure(common, bodies, result);
  result.volume = CGAL::to_double(sum.volume);
  if constexpr (!kIsExact)
    if (!is_narrow(sum, result, size_of(a) + size_of(b))) return std::nullopt;
  result.area = rounded(sum.area);
  result.area_moment = rounded(sum.area_moment);
  result.needed_exact = kIsExact;
  return result;
}

}  // namespace

Overlap overlap_unfiltered(const Body& a, const Body& b, double flush_tolerance) {
  return *overlap_in<Lazy>(a, b, flush_tolerance);
}

Overlap overlap(const Body& a, const Body& b, double flush_tolerance) {
  try {
    const Interval::Protector upward_rounding;
    if (const auto result = overlap_in<Interval>(a, b, flush_tolerance)) return *result;
  } catch (const CGAL::Uncertain_conversion_exception&) {
    // A sign is open: rationals decide.
  }
  return overlap_unfiltered(a, b, flush_tolerance);
}

}  // namespace exact
