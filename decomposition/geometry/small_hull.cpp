// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/geometry/small_hull.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace decomposition {
namespace {

// A point counts as outside a face by this share of the size of the point set. It is a distance, the same for large and
// small faces, so that faces in one plane agree; rounding is about 1e-16 of the size.
constexpr double kOrientationTolerance = 1e-13;
// Below this share of size^3 the first tetrahedron is called flat.
constexpr double kFlatTolerance = 1e-12;

double triple(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return dot(cross(b - a, c - a), d - a); }

constexpr int kWidenings = 6;  // of the tolerance, by this factor each, where rounding spoils the topology
constexpr double kWidening = 30;

}  // namespace

bool SmallHull::start_with_tetrahedron(const std::vector<Vec3>& points, std::array<int, 4>& corners) {
  const int n = static_cast<int>(points.size());
  const auto farthest = [&](auto&& measure) {
    int best = 0;
    double largest = -1;
    for (int i = 0; i < n; ++i)
      if (const double m = measure(points[static_cast<std::size_t>(i)]); m > largest) largest = m, best = i;
    return best;
  };
  const auto at = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  const int a = farthest([&](const Vec3& p) { return norm(p - at(0)); });
  const int b = farthest([&](const Vec3& p) { return norm(p - at(a)); });
  const int c = farthest([&](const Vec3& p) { return norm(cross(p - at(a), at(b) - at(a))); });
  const int d = farthest([&](const Vec3& p) { return std::abs(triple(at(a), at(b), at(c), p)); });
  const double size = norm(at(b) - at(a));
  tolerance_ = kOrientationTolerance * size;
  const double six_volumes = triple(at(a), at(b), at(c), at(d));
  if (!(std::abs(six_volumes) > kFlatTolerance * size * size * size)) return false;
  // d must lie below (a, b, c), so that all four faces look outward.
  corners = six_volumes < 0 ? std::array<int, 4>{a, b, c, d} : std::array<int, 4>{a, c, b, d};
  return true;
}

void SmallHull::add_face(int a, int b, int c, const std::vector<Vec3>& points) {
  const Vec3 &pa = points[static_cast<std::size_t>(a)], &pb = points[static_cast<std::size_t>(b)],
             &pc = points[static_cast<std::size_t>(c)];
  const auto face = static_cast<std::int16_t>(faces_.size());
  faces_.push_back({a, b, c});
  const Vec3 twice_area = cross(pb - pa, pc - pa);
  const double length = norm(twice_area);
  normals_.push_back(length > 0 ? (1 / length) * twice_area : Vec3{});
  offsets_.push_back(dot(normals_.back(), pa));
  edge_face(a, b) = edge_face(b, c) = edge_face(c, a) = face;
}

void SmallHull::remove_face(int face) {
  const auto f = static_cast<std::size_t>(face);
  faces_[f] = faces_.back();
  normals_[f] = normals_.back();
  offsets_[f] = offsets_.back();
  faces_.pop_back();
  normals_.pop_back();
  offsets_.pop_back();
  if (f == faces_.size()) return;
  const auto& [a, b, c] = faces_[f];
  edge_face(a, b) = edge_face(b, c) = edge_face(c, a) = static_cast<std::int16_t>(face);
}

bool SmallHull::horizon_is_a_loop() {
  for (const auto& [a, b] : horizon_) next_[static_cast<std::size_t>(a)] = next_[static_cast<std::size_t>(b)] = -1;
  for (const auto& [a, b] : horizon_) {
    if (next_[static_cast<std::size_t>(a)] >= 0) return false;
    next_[static_cast<std::size_t>(a)] = b;
  }
  const int start = horizon_.front()[0];
  std::size_t length = 1;
  for (int v = next_[static_cast<std::size_t>(start)]; v != start && v >= 0 && length <= horizon_.size(); ++length)
    v = next_[static_cast<std::size_t>(v)];
  return length == horizon_.size();
}

/// Edges around the faces that see p by more than `margin`; false if they do not make one loop.
bool SmallHull::find_horizon(const Vec3& p, double margin) {
  const int n = static_cast<int>(faces_.size());
  visible_.clear();
  is_visible_.resize(faces_.size());
  for (int f = 0; f < n; ++f) {
    const auto i = static_cast<std::size_t>(f);
    is_visible_[i] = dot(normals_[i], p) - offsets_[i] > margin;
    if (is_visible_[i]) visible_.push_back(f);
  }
  horizon_.clear();
  if (visible_.empty()) return true;
  if (static_cast<int>(visible_.size()) == n) return false;
  for (const int f : visible_) {
    const auto face = faces_[static_cast<std::size_t>(f)];
    for (int k = 0; k < 3; ++k) {
      const int a = face[static_cast<std::size_t>(k)], b = face[static_cast<std::size_t>((k + 1) % 3)];
      const int opposite = edge_face(b, a);
      if (!is_visible_[static_cast<std::size_t>(opposite)]) horizon_.push_back({a, b});
    }
  }
  return !horizon_.empty() && horizon_is_a_loop();
}

void SmallHull::insert(int point, const std::vector<Vec3>& points) {
  const Vec3 p = points[static_cast<std::size_t>(point)];
  // Where rounding makes faces in one plane with p disagree, they do not count as seeing it; a point that is not clear
  // of its neighbours even so adds nothing.
  double margin = tolerance_;
  bool is_found = find_horizon(p, margin);
  for (int widening = 0; !is_found && widening < kWidenings; ++widening)
    is_found = find_horizon(p, margin *= kWidening);
  if (!is_found || visible_.empty()) return;
  std::sort(visible_.begin(), visible_.end(), std::greater<>());
  for (const int f : visible_) remove_face(f);
  for (const auto& [a, b] : horizon_) add_face(a, b, point, points);
}

bool SmallHull::finish(const std::vector<Vec3>& points) {
  is_vertex_.fill(0);
  vertex_count_ = 0;
  volume_ = 0;
  const Vec3 origin = points.front();
  for (const auto& [a, b, c] : faces_) {
    for (const int v : {a, b, c})
      if (!is_vertex_[static_cast<std::size_t>(v)]) is_vertex_[static_cast<std::size_t>(v)] = 1, ++vertex_count_;
    volume_ += triple(origin, points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)],
                      points[static_cast<std::size_t>(c)]);
  }
  volume_ /= 6;
  return static_cast<int>(faces_.size()) == 2 * vertex_count_ - 4 && volume_ > 0;  // Euler
}

bool SmallHull::build(const std::vector<Vec3>& given) {
  // About one of the points: far from the origin the products below would lose their last digits.
  local_.resize(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) local_[i] = given[i] - given.front();
  const std::vector<Vec3>& points = local_;
  faces_.clear();
  normals_.clear();
  offsets_.clear();
  is_linked_ = false;
  volume_ = 0;
  vertex_count_ = 0;
  is_vertex_.fill(0);
  const int n = static_cast<int>(points.size());
  std::array<int, 4> t;
  if (n < 4 || n > kMaxPoints || !start_with_tetrahedron(points, t)) return false;
  add_face(t[0], t[1], t[2], points);
  add_face(t[0], t[2], t[3], points);
  add_face(t[0], t[3], t[1], points);
  add_face(t[1], t[3], t[2], points);
  for (int i = 0; i < n; ++i)
    if (i != t[0] && i != t[1] && i != t[2] && i != t[3]) insert(i, points);
  return finish(points);
}

double hull_thickness(const SmallHull& hull, const std::vector<Vec3>& points) {
  std::array<char, SmallHull::kMaxPoints> is_corner{};
  std::vector<Vec3> corners;
  for (const auto& face : hull.faces())
    for (const int v : face) {
      if (is_corner[static_cast<std::size_t>(v)]) continue;
      is_corner[static_cast<std::size_t>(v)] = 1;
      corners.push_back(points[static_cast<std::size_t>(v)]);
    }
  double thickness = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : hull.faces()) {
    const Vec3 &pa = points[static_cast<std::size_t>(a)], &pb = points[static_cast<std::size_t>(b)],
               &pc = points[static_cast<std::size_t>(c)];
    const Vec3 normal = cross(pb - pa, pc - pa);
    const double length = norm(normal);
    if (!(length > 0)) continue;
    double deepest = 0;
    for (const Vec3& corner : corners) deepest = std::max(deepest, dot(normal, pa - corner));
    thickness = std::min(thickness, deepest / length);
  }
  return thickness;
}

}  // namespace decomposition
