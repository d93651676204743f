// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/poisson_surface.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/facets_in_complex_2_to_triangle_mesh.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Poisson_reconstruction_function.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/make_surface_mesh.h>
#include <CGAL/property_map.h>

#include <utility>
#include <vector>

#include "shape_pipeline/meshes/soup_cleaning.h"
#include "shape_pipeline/surfaces/surface_mesh_conversion.h"

namespace shape_pipeline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using OrientedPoint = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using PoissonFunction = CGAL::Poisson_reconstruction_function<Kernel>;

/// A vertex or cell with a serial number. The mesher keeps sets ordered by handle; with the number their order is that
/// of creation, without it that of addresses, and the surface would depend on where memory happened to lie.
template <class Base>
class Numbered : public Base {
 public:
  using Base::Base;
  using Has_timestamp = CGAL::Tag_true;
  template <class DataStructure>
  struct Rebind_TDS {
    using Other = Numbered<typename Base::template Rebind_TDS<DataStructure>::Other>;
  };
  std::size_t time_stamp() const { return number_; }
  void set_time_stamp(const std::size_t& number) { number_ = number; }

 private:
  std::size_t number_ = static_cast<std::size_t>(-1);  // none yet: the container gives it
};

// The components of CGAL::Surface_mesh_default_triangulation_3, numbered.
using Traits = CGAL::Robust_circumcenter_traits_3<Kernel>;
using Vertex = Numbered<CGAL::Surface_mesh_vertex_base_3<Traits>>;
using Cell = Numbered<
    CGAL::Delaunay_triangulation_cell_base_with_circumcenter_3<Traits, CGAL::Surface_mesh_cell_base_3<Traits>>>;
using Triangulation = CGAL::Delaunay_triangulation_3<Traits, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
using Complex = CGAL::Surface_mesh_complex_2_in_triangulation_3<Triangulation>;

constexpr double kFacetAngle = 20;       // [deg] smallest facet angle that the refinement asks for
constexpr double kSphereFactor = 5;      // meshing sphere / bounding sphere: room for a surface that bulges over a gap
constexpr double kDichotomyPart = 1e-3;  // error of a surface point / facet distance

}  // namespace

catalog::TriangleMesh poisson_surface(const PointCloud& cloud, double spacing, const PoissonResolution& resolution) {
  // The mesher draws its first points at random: a fixed seed makes the result repeatable.
  CGAL::get_default_random() = CGAL::Random(1);

  std::vector<OrientedPoint> points;
  points.reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const auto& p = cloud.points[i];
    const auto& n = cloud.normals[i];
    points.emplace_back(Kernel::Point_3(p[0], p[1], p[2]), Kernel::Vector_3(n[0], n[1], n[2]));
  }
  PoissonFunction function(points.begin(), points.end(), CGAL::First_of_pair_property_map<OrientedPoint>(),
                           CGAL::Second_of_pair_property_map<OrientedPoint>());
  if (!function.compute_implicit_function()) return {};

  const double sphere_radius = kSphereFactor * CGAL::approximate_sqrt(function.bounding_sphere().squared_radius());
  const double facet_distance = resolution.facet_distance * spacing;
  const CGAL::Implicit_surface_3<Kernel, PoissonFunction> surface(
      function, Kernel::Sphere_3(function.get_inner_point(), sphere_radius * sphere_radius),
      kDichotomyPart * facet_distance / sphere_radius);
  const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(kFacetAngle, resolution.facet_radius * spacing,
                                                                      facet_distance);

  Triangulation triangulation;
  Complex complex(triangulation);
  CGAL::make_surface_mesh(complex, surface, criteria, CGAL::Manifold_with_boundary_tag());
  if (triangulation.number_of_vertices() == 0) return {};
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  CGAL::facets_in_complex_2_to_triangle_mesh(complex, mesh);
  // The mesher lists its facets by address.
  catalog::TriangleMesh result = copy_from_surface_mesh(mesh);
  put_in_canonical_order(result);
  return result;
}

}  // namespace shape_pipeline
