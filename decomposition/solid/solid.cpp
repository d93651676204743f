// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/solid/solid.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "catalog/mass_properties.h"
#include "decomposition/geometry/coplanar_groups.h"

namespace decomposition {
namespace {

constexpr double kMostCellsAlong = 600;  // bounds the memory for needles and plates
constexpr int kMostFacets = 400;         // of a solid that counts as faceted
constexpr double kCoplanar = 1e-10;      // share of the diagonal: triangles this flat are one facet
// Points spread by equal steps: columns of a drawn solid may be equally long, and be hit at one height.
constexpr double kLeastSpread = 0.5;
constexpr std::size_t kFewPlaces = 20;  // lie anyhow
constexpr double kOpposite = 1e-9;      // sum of the normals of two faces that touch
constexpr double kReentrant = 1e-6;  // share of the diagonal: a neighbour this far above a face makes a re-entrant edge
constexpr int kPadding = 3;          // empty cells around the solid, so that look-ups near it need no bounds

/// Clips the line (x, y, z in range) by a half-space.
ZInterval clip_by_plane(const Plane& plane, double x, double y, ZInterval range) {
  const double rest = plane.offset - plane.normal.x * x - plane.normal.y * y;
  if (plane.normal.z > 0)
    range.high = std::min(range.high, rest / plane.normal.z);
  else if (plane.normal.z < 0)
    range.low = std::max(range.low, rest / plane.normal.z);
  else if (rest < 0)
    range.high = range.low;
  return range;
}

struct PointsAlong {
  std::vector<Vec3> places;
  double spread = 0;  // variance of where they lie in their stretch, over that of even places [-]
};

/// In equal steps of cumulative length: stratified, in proportion to the volume. `start`: of the first, in steps.
PointsAlong points_along(const std::vector<Stretch>& stretches, double step, double start) {
  PointsAlong result;
  double next = step * start, passed = 0, sum = 0, squares = 0;
  for (const Stretch& s : stretches) {
    const double length = s.high - s.low;
    for (; next < passed + length; next += step) {
      result.places.push_back({s.x, s.y, s.low + next - passed});
      const double share = (next - passed) / length;
      sum += share;
      squares += share * share;
    }
    passed += length;
  }
  const auto count = static_cast<double>(result.places.size());
  result.spread = 12 * (squares / count - (sum / count) * (sum / count));
  return result;
}

/// About as long, but by the golden ratio off a whole number of columns, or off a whole part of one.
double uneven_step(double step, double column) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  return step > column ? column * (std::floor(step / column) + golden) : column / (std::floor(column / step) + golden);
}

}  // namespace

std::shared_ptr<const Solid::Surface> Solid::surface_of(const catalog::TriangleMesh& mesh) {
  auto surface = std::make_shared<Surface>();
  surface->faces = mesh.faces;
  surface->vertices.reserve(mesh.vertices.size());
  for (const catalog::Point& p : mesh.vertices) surface->vertices.push_back(to_vec3(p));
  surface->volume = catalog::volume_moments(mesh).volume;
  surface->diagonal = bounding_box(surface->vertices).diagonal();
  find_facets(*surface);
  return surface;
}

Solid::Solid(const catalog::TriangleMesh& mesh, double cell_count) : Solid(surface_of(mesh), cell_count) {}

Solid::Solid(const Solid& other, double cell_count) : Solid(other.surface_, cell_count) {}

Solid::Solid(std::shared_ptr<const Surface> surface, double cell_count) : surface_(std::move(surface)) {
  const Box box = bounding_box(vertices());
  const Vec3 size = box.high - box.low;
  cell_ = std::fmax(std::cbrt(size.x * size.y * size.z / cell_count), diagonal() / kMostCellsAlong);
  cells_per_length_ = 1 / cell_;
  const auto cells = [&](double length) { return static_cast<int>(std::ceil(length / cell_)) + 2 * kPadding; };
  nx_ = cells(size.x);
  ny_ = cells(size.y);
  nz_ = cells(size.z);
  const Vec3 middle = 0.5 * (box.low + box.high);
  origin_ = middle - (0.5 * cell_) * Vec3{double(nx_), double(ny_), double(nz_)};
  rays_ = {origin_.x, origin_.y, cell_ / 2, 2 * nx_, 2 * ny_, {}, {}};
  columns_ = intersect(rays_, vertices(), faces());
  fill_field();
}

void Solid::find_facets(Surface& surface) {
  const auto& [vertices, faces] = std::tie(surface.vertices, surface.faces);
  const double diagonal = surface.diagonal;
  const CoplanarGroups groups = coplanar_groups(vertices, faces, kCoplanar * diagonal, kMostFacets);
  surface.is_faceted = groups.count() <= kMostFacets;
  if (!surface.is_faceted) return;
  const std::vector<std::array<int, 3>> neighbours = face_neighbours(faces);
  std::vector<char> is_wanted(groups.planes.size(), 0);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      if (neighbours[f][k] < 0) continue;
      const auto next = static_cast<std::size_t>(neighbours[f][k]);
      const auto group = static_cast<std::size_t>(groups.group_of[f]);
      // Re-entrant: the neighbour rises above this face's plane.
      const bool rises = std::any_of(faces[next].begin(), faces[next].end(), [&](int v) {
        return groups.planes[group].signed_distance(vertices[static_cast<std::size_t>(v)]) > kReentrant * diagonal;
      });
      if (!rises) continue;
      is_wanted[group] = 1;
      surface.reentrant_edges.push_back(
          {vertices[static_cast<std::size_t>(faces[f][k])], vertices[static_cast<std::size_t>(faces[f][(k + 1) % 3])]});
    }
  // Where faces of two bodies touch there is no such edge.
  for (std::size_t a = 0; a < is_wanted.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (norm(groups.planes[a].normal + groups.planes[b].normal) < kOpposite &&
          std::abs(groups.planes[a].offset + groups.planes[b].offset) < kCoplanar * diagonal)
        is_wanted[a] = is_wanted[b] = 1;
  std::vector<std::size_t> order;
  for (std::size_t g = 0; g < is_wanted.size(); ++g)
    if (is_wanted[g]) order.push_back(g);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return groups.areas[a] > groups.areas[b]; });
  for (const std::size_t g : order) surface.facet_planes.push_back(groups.planes[g]);
}

void Solid::fill_field() {
  std::vector<float> filled(static_cast<std::size_t>(nx_) * ny_ * nz_, 0.0f);
  const auto nz = static_cast<std::size_t>(nz_);
  for (int j = 0; j < rays_.ny; ++j)
    for (int i = 0; i < rays_.nx; ++i) {
      float* column = &filled[(static_cast<std::size_t>(j / 2) * nx_ + i / 2) * nz];
      const std::size_t ray = rays_.index(i, j);
      for (std::size_t k = columns_.first[ray]; k < columns_.first[ray + 1]; ++k) {
        const double low = (columns_.intervals[k].low - origin_.z) / cell_;
        const double high = (columns_.intervals[k].high - origin_.z) / cell_;
        for (int z = static_cast<int>(low); z <= static_cast<int>(high); ++z)
          column[z] += static_cast<float>(0.25 * std::max(0.0, std::min(high, z + 1.0) - std::max(low, double(z))));
      }
    }
  field_.resize(filled.size());
  for (std::size_t c = 0; c < filled.size(); ++c)
    field_[c] = static_cast<std::uint8_t>(std::min(255.0f, 255.0f * filled[c] + 0.5f));
}

std::vector<Stretch> Solid::stretches_inside(const std::vector<Plane>& cell, int stride) const {
  std::vector<Stretch> stretches;
  for (int j = 0; j < rays_.ny; j += stride)
    for (int i = 0; i < rays_.nx; i += stride) {
      const std::size_t ray = rays_.index(i, j);
      for (std::size_t k = columns_.first[ray]; k < columns_.first[ray + 1]; ++k) {
        const double x = rays_.x(i, j), y = rays_.y(i, j);
        ZInterval part = columns_.intervals[k];
        for (const Plane& plane : cell) part = clip_by_plane(plane, x, y, part);
        if (part.high > part.low) stretches.push_back({x, y, part.low, part.high});
      }
    }
  return stretches;
}

std::vector<Stretch> clipped(const std::vector<Stretch>& stretches, const Plane& plane) {
  std::vector<Stretch> kept;
  for (const Stretch& s : stretches) {
    const ZInterval part = clip_by_plane(plane, s.x, s.y, {s.low, s.high});
    if (part.high > part.low) kept.push_back({s.x, s.y, part.low, part.high});
  }
  return kept;
}

double Solid::volume_inside(const std::vector<Plane>& cell) const {
  double length = 0;
  for (const Stretch& s : stretches_inside(cell)) length += s.high - s.low;
  return length * rays_.cell * rays_.cell;
}

std::vector<Vec3> Solid::points_inside(const std::vector<Plane>& cell, int count, Random& random) const {
  const std::vector<Stretch> stretches = stretches_inside(cell);
  double length = 0;
  for (const Stretch& s : stretches) length += s.high - s.low;
  const double start = random.uniform();
  const PointsAlong points = points_along(stretches, length / count, start);
  if (points.spread > kLeastSpread || points.places.size() < kFewPlaces) return points.places;
  return points_along(stretches, uneven_step(length / count, length / static_cast<double>(stretches.size())), start)
      .places;
}

RegionMoments moments_of_points(const std::vector<Vec3>& points, double volume) {
  RegionMoments moments;
  moments.volume = volume;
  for (const Vec3& p : points) moments.centroid += p;
  moments.centroid = (1.0 / static_cast<double>(points.size())) * moments.centroid;
  catalog::Matrix3 covariance{};
  for (const Vec3& p : points) {
    const catalog::Point d = to_point(p - moments.centroid);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) covariance[i][j] += d[i] * d[j] / static_cast<double>(points.size());
  }
  catalog::Point variances;
  catalog::Matrix3 axes;
  catalog::symmetric_eigen(covariance, variances, axes);
  for (int a = 0; a < 3; ++a)  // a uniform ellipsoid of semi-axis s has the variance s^2 / 5 along it
    moments.semi_axes[a] = std::sqrt(5 * std::fmax(variances[a], 0.0)) * to_vec3(axes[a]);
  return moments;
}

}  // namespace decomposition
