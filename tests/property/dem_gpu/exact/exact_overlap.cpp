// SPDX-License-Identifier: Apache-2.0
#include "tests/property/dem_gpu/exact/exact_overlap.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Lazy_exact_nt.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "tests/property/dem_gpu/exact/exact_solid.h"

namespace exact {
namespace {

/// Its rounding mode is set once, in overlap().
using Interval = CGAL::Interval_nt_advanced;
using Lazy = CGAL::Lazy_exact_nt<CGAL::Exact_rational>;

/// Two planes with nearly equal normals, seen from a point. (Conversions to double lose far less than any
/// tolerance.)
struct NearPlanes {
  double offset, sine;

  template <class Number>
  NearPlanes(const HalfSpace<Number>& a, const HalfSpace<Number>& b, const Vec3& from) {
    const Vec3 normal_a = unit(a), normal_b = unit(b);
    offset = std::abs(dot(normal_a, rounded(a.point) - from) - dot(normal_b, rounded(b.point) - from));
    sine = norm(normal_a - normal_b);
  }
  /// How far apart they are at most within `reach`.
  double largest_gap(double reach) const { return offset + reach * sine; }
  bool cross_within(double reach) const { return offset <= reach * sine && sine < 1e-5; }

 private:
  template <class Number>
  static Vec3 unit(const HalfSpace<Number>& plane) {
    const Vec3 normal = rounded(plane.normal);
    return (1 / norm(normal)) * normal;
  }
};

/// What a facet of the overlap inherits from the face it comes from: the normal, and whether that face is flush with
/// one of the other body.
template <class Number>
class BodyFaces {
 public:
  BodyFaces(const Mesh<Number>& a, const Mesh<Number>& b, const FlushRule& flush)
      : normals_a_(normals(a)), normals_b_(normals(b)), of_a_(normals_a_.size(), -1), of_b_(normals_b_.size(), -1) {
    constexpr double kClear = 1.1;
    for (std::size_t i = 0; i < normals_a_.size(); ++i)
      for (std::size_t j = 0; j < normals_b_.size(); ++j) {
        const NearPlanes planes(a.plane(static_cast<int>(i)), b.plane(static_cast<int>(j)), flush.middle);
        const double apart = planes.largest_gap(flush.reach);
        if (apart <= flush.tolerance)
          of_a_[i] = std::max(of_a_[i], apart), of_b_[j] = std::max(of_b_[j], apart);
        else if (planes.cross_within(flush.reach))
          near_seam_ += flush.reach / planes.sine;
        may_be_flush_ |= apart <= kClear * flush.tolerance && kClear * apart >= flush.tolerance;
      }
  }
  bool is_flush(const typename Solid<Number>::Face& face) const { return gap(face) >= 0; }
  /// To the plane that the face is flush with; negative if there is none.
  double gap(const typename Solid<Number>::Face& face) const {
    return face.is_of_a ? of_a_[face.source] : of_b_[face.source];
  }
  const Vec3& normal(const typename Solid<Number>::Face& face) const {
    return face.is_of_a ? normals_a_[face.source] : normals_b_[face.source];
  }
  bool may_be_flush() const { return may_be_flush_; }
  /// As Overlap::seam, of nearly flush planes that cross near the overlap, and might in it.
  double near_seam() const { return near_seam_; }

 private:
  static std::vector<Vec3> normals(const Mesh<Number>& mesh) {
    std::vector<Vec3> all;
    for (const auto& face : mesh.solid.faces) all.push_back(rounded(mesh.plane(face.source).normal));
    return all;
  }
  std::vector<Vec3> normals_a_, normals_b_;
  std::vector<double> of_a_, of_b_;  // gaps
  bool may_be_flush_ = false;
  double near_seam_ = 0;
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
  overlap.seam = bodies.near_seam();
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
    if (is_flush) overlap.flush_area += 0.5 * twice, overlap.flush_volume += bodies.gap(face) * norm(twice) / 2;
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
std::optional<Overlap> overlap_in(const Body& a, const Body& b, const FlushRule& flush) {
  const Mesh<Number> mesh_a(placed<Number>(a, a.pose.position, b.pose.orientation, true));
  const Mesh<Number> mesh_b(placed<Number>(b, a.pose.position, a.pose.orientation, false));
  Solid<Number> common = mesh_b.solid;
  common.faces_of_a.resize(common.vertices.size());
  for (const auto& face : mesh_a.solid.faces) {
    clip(common, mesh_a, mesh_b, face.source);
    if (common.faces.empty()) return Overlap{};
  }
  const BodyFaces<Number> bodies(mesh_a, mesh_b, flush);
  Overlap result;
  result.may_be_flush = bodies.may_be_flush();
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

Overlap overlap_unfiltered(const Body& a, const Body& b, const FlushRule& flush) {
  return *overlap_in<Lazy>(a, b, flush);
}

Overlap overlap(const Body& a, const Body& b, const FlushRule& flush) {
  try {
    const Interval::Protector upward_rounding;
    if (const auto result = overlap_in<Interval>(a, b, flush)) return *result;
  } catch (const CGAL::Uncertain_conversion_exception&) {
    // A sign is open: rationals decide.
  }
  return overlap_unfiltered(a, b, flush);
}

}  // namespace exact
