// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "catalog/triangle_mesh.h"
#include "decomposition/geometry/random.h"
#include "decomposition/solid/ray_grid.h"

namespace decomposition {

/// Volume and second moments of a region, for starting a fit.
struct RegionMoments {
  double volume = 0;
  Vec3 centroid;
  Vec3 semi_axes[3];  // of the ellipsoid of uniform density with the same second moments
};

/// A stretch of a column inside the solid: a line along z.
struct Stretch {
  double x, y, low, high;
};

/// What is left of stretches behind a plane.
std::vector<Stretch> clipped(const std::vector<Stretch>& stretches, const Plane& plane);

/// What the search asks of the mesh: an occupancy field for the gradients and z-columns for exact lengths.
/// Cells are cubes whose number is fixed, so that a slab gets as many of them across as its volume allows.
class Solid {
 public:
  /// `mesh` has passed check_solid. `cell_count`: of the occupancy field, about.
  Solid(const catalog::TriangleMesh& mesh, double cell_count);
  /// The same solid, its surface shared, with another number of cells.
  Solid(const Solid& other, double cell_count);

  /// Share of the neighbourhood of p that is filled, 0 to 1, trilinear between cell centres.
  double occupancy(const Vec3& p) const {
    const Vec3 g = to_field(p);
    return is_in_field(g) ? field_at(g) : 0;
  }

  /// Coordinates in cells of the field, counted from the centre of the first; field_at needs is_in_field.
  Vec3 to_field(const Vec3& p) const {
    return {(p.x - origin_.x) * cells_per_length_ - 0.5, (p.y - origin_.y) * cells_per_length_ - 0.5,
            (p.z - origin_.z) * cells_per_length_ - 0.5};
  }
  bool is_in_field(const Vec3& g) const {
    return g.x >= 0 && g.y >= 0 && g.z >= 0 && g.x < nx_ - 1 && g.y < ny_ - 1 && g.z < nz_ - 1;
  }
  double field_at(const Vec3& g) const {
    const int i = static_cast<int>(g.x), j = static_cast<int>(g.y), k = static_cast<int>(g.z);
    const auto fx = static_cast<float>(g.x - i), fy = static_cast<float>(g.y - j), fz = static_cast<float>(g.z - k);
    const std::uint8_t* c00 = &field_[(static_cast<std::size_t>(j) * nx_ + i) * nz_ + k];
    const std::uint8_t* c10 = c00 + nz_;
    const std::uint8_t* c01 = c00 + static_cast<std::size_t>(nx_) * nz_;
    const std::uint8_t* c11 = c01 + nz_;
    const auto along_z = [fz](const std::uint8_t* c) {
      return static_cast<float>(c[0]) + fz * static_cast<float>(c[1] - c[0]);
    };
    const float low = along_z(c00) + fx * (along_z(c10) - along_z(c00));
    const float high = along_z(c01) + fx * (along_z(c11) - along_z(c01));
    return (low + fy * (high - low)) * (1 / 255.0f);
  }

  /// Share of the cell of the field at g that is filled: for sums over many places at random, where it is as good as
  /// field_at and takes one look-up instead of eight.
  double filled_at(const Vec3& g) const {
    const int i = static_cast<int>(g.x + 0.5), j = static_cast<int>(g.y + 0.5), k = static_cast<int>(g.z + 0.5);
    return (1 / 255.0) * field_[(static_cast<std::size_t>(j) * nx_ + i) * nz_ + k];
  }

  const std::vector<Vec3>& vertices() const { return surface_->vertices; }
  const std::vector<catalog::Triangle>& faces() const { return surface_->faces; }
  double volume() const { return surface_->volume; }      // exact, by signed tetrahedra
  double diagonal() const { return surface_->diagonal; }  // of the bounding box
  double cell() const { return cell_; }                   // edge of a cell of the field
  const RayGrid& rays() const { return rays_; }           // 2 x 2 rays a cell
  const RayIntervals& columns() const { return columns_; }

  /// Few flat facets, as a drawn solid has and a scan has not: worth looking for exactly convex pieces.
  bool is_faceted() const { return surface_->is_faceted; }
  /// Planes of the facets at re-entrant edges of a faceted solid, largest facets first; none for others.
  const std::vector<Plane>& facet_planes() const { return surface_->facet_planes; }
  /// Ends of the re-entrant edges of a faceted solid; none for others.
  const std::vector<std::array<Vec3, 2>>& reentrant_edges() const { return surface_->reentrant_edges; }

  /// The part of the solid in the cell, on every stride-th column in x and y.
  std::vector<Stretch> stretches_inside(const std::vector<Plane>& cell, int stride = 1) const;
  /// Volume of the part of the solid in the cell, integrated over the columns.
  double volume_inside(const std::vector<Plane>& cell) const;
  /// `count` points spread over the part of the solid in the cell, fewer if the cell is nearly empty.
  std::vector<Vec3> points_inside(const std::vector<Plane>& cell, int count, Random& random) const;

 private:
  struct Surface {
    std::vector<Vec3> vertices;
    std::vector<catalog::Triangle> faces;
    double volume = 0, diagonal = 0;
    bool is_faceted = false;
    std::vector<Plane> facet_planes;
    std::vector<std::array<Vec3, 2>> reentrant_edges;
  };
  Solid(std::shared_ptr<const Surface> surface, double cell_count);
  static std::shared_ptr<const Surface> surface_of(const catalog::TriangleMesh& mesh);
  static void find_facets(Surface& surface);
  void fill_field();

  std::shared_ptr<const Surface> surface_;
  double cell_ = 0, cells_per_length_ = 0;
  Vec3 origin_;  // low corner of the field
  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<std::uint8_t> field_;  // nz x ny x nx, 255 is full
  RayGrid rays_;
  RayIntervals columns_;
};

/// Moments of a set of points that stands for a region of that volume.
RegionMoments moments_of_points(const std::vector<Vec3>& points, double volume);

}  // namespace decomposition
