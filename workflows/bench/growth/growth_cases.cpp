// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/growth/growth_cases.h"

#include <cmath>
#include <numbers>

#include "tests/benchmark/scenes/hull_part.h"
#include "tests/benchmark/scenes/solids.h"
#include "workflows/bench/growth/beds.h"
#include "workflows/bench/growth/grid_mesh.h"

namespace workflows {
namespace {

using benchmark_scenes::Law;
using dem_gpu::Scene;
using dem_gpu::Vec3;

// N log N is an exponent of 0.1 or so over these numbers; one more tenth for caches that grow too small.
constexpr double kLargestExponent = 0.2;
constexpr double kDearestRatio = 3;  // of a size ratio of 1:10 over 1:1
constexpr double kSphere = 0.01;     // diameter of S1 [m]

/// Slope of log y over log x by least squares.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::log(x[i]), b = std::log(y[i]);
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// One curve with its figures.
class Growth {
 public:
  Growth(const std::string& plot, const std::string& of) : of_(of), curve_{plot, of, {}, {}, {}} {}
  void add(double x, const std::string& name, const BedCost& cost) {
    const auto figure = [&](const std::string& what, double value, const std::string& unit) {
      result_.figures.push_back({name + ": " + what, value, unit, {}, ""});
    };
    figure("time of a particle in a step", cost.particle_step(), "ns");
    figure("of it when listed anew, each time", cost.listing_time, "ns");
    figure("contacts of a particle", cost.contacts, "-");
    figure("memory of a particle", cost.memory, "bytes");
    curve_.x.push_back(x);
    curve_.y.push_back(cost.particle_step());
    curve_.point_names.push_back(name);
  }
  double last_over_first(std::size_t last) const { return curve_.y[last] / curve_.y[0]; }
  CaseResult result(std::optional<Goal> goal_of_exponent) {
    result_.figures.push_back({"exponent", exponent(curve_.x, curve_.y), "-", goal_of_exponent, ""});
    result_.curves = {curve_};
    return result_;
  }
  void add_figure(const Figure& figure) { result_.figures.push_back(figure); }

 private:
  std::string of_;
  CaseResult result_;
  PlotCurve curve_;
};

/// Spheres of `ratio` times the diameter, half sunk in the top of a bed whose spheres make room for them.
Scene with_large_spheres(Scene bed, double ratio) {
  double top = 0, width = 0;
  for (const dem_gpu::Body& body : bed.bodies) {
    top = std::max(top, body.position.z);
    width = std::max(width, body.position.x);
  }
  const double radius = ratio * kSphere / 2, pitch = 2.4 * radius;
  const int across = std::max(1, static_cast<int>(width / pitch));
  const double middle = std::max(top, radius);
  std::vector<Vec3> centres;
  for (int row = 0; row < across; ++row)
    for (int column = 0; column < across; ++column)
      centres.push_back({(column + 0.5) * width / across, (row + 0.5) * width / across, middle});
  std::erase_if(bed.bodies, [&](const dem_gpu::Body& body) {
    for (const Vec3& centre : centres)
      if (norm(body.position - centre) < radius + kSphere / 2) return true;
    return false;
  });
  for (const Vec3& centre : centres) {
    dem_gpu::Body body;
    body.scale = ratio;
    body.position = centre;
    bed.bodies.push_back(body);
  }
  return bed;
}

dem_gpu::Shape cut_cube(double edge, const std::array<int, 3>& cuts) {
  std::vector<catalog::ConvexPart> parts;
  const Vec3 size{edge / cuts[0], edge / cuts[1], edge / cuts[2]};
  for (int i = 0; i < cuts[0]; ++i)
    for (int j = 0; j < cuts[1]; ++j)
      for (int k = 0; k < cuts[2]; ++k) {
        const Vec3 low{i * size.x, j * size.y, k * size.z};
        catalog::ConvexPart part = benchmark_scenes::box_between(low, low + size);
        const auto cover = [&](bool is_covered, const Vec3& side) {
          if (is_covered) benchmark_scenes::face_towards(part, side).kind = catalog::FaceKind::inner;
        };
        cover(i > 0, {-1, 0, 0});
        cover(i + 1 < cuts[0], {1, 0, 0});
        cover(j > 0, {0, -1, 0});
        cover(j + 1 < cuts[1], {0, 1, 0});
        cover(k > 0, {0, 0, -1});
        cover(k + 1 < cuts[2], {0, 0, 1});
        parts.push_back(part);
      }
  return dem_gpu::polyhedral_shape("cut cube", parts);
}

/// The law of S2 for a scene that had spheres.
void set_law_of_s2(Scene& scene) {
  const Scene s2 = benchmark_scenes::mixed_box({});
  scene.polyhedral_law = s2.polyhedral_law;
  scene.run.time_step = dem_gpu::time_step(s2);
}

}  // namespace

CaseResult measure_number(const std::string& scene) {
  Growth growth("number", scene == "s1-box" ? "spheres (S1)" : "cubes and truncated tetrahedra (S2)");
  const std::vector<int> across = scene == "s1-box" ? std::vector<int>{1, 2, 6, 20} : std::vector<int>{2, 6, 20};
  for (const int k : across) {
    const Scene whole = bed({scene, Law::depth_potential, k});
    growth.add(static_cast<double>(whole.bodies.size()), std::to_string(whole.bodies.size()) + " bodies",
               cost_of(whole));
  }
  return growth.result(at_most(kLargestExponent));
}

CaseResult measure_size_ratio() {
  Growth growth("ratio", "spheres, a layer of large ones half sunk in the bed");
  for (const int ratio : {1, 3, 10, 30}) {
    const Scene whole = bed({"s1-box", Law::depth_potential, 4});
    growth.add(ratio, "1:" + std::to_string(ratio), cost_of(ratio > 1 ? with_large_spheres(whole, ratio) : whole));
  }
  growth.add_figure({"1:10 over 1:1", growth.last_over_first(2), "-", at_most(kDearestRatio), ""});
  return growth.result({});
}

CaseResult measure_parts() {
  Growth growth("parts", "a cube cut into parts, in a bed of cubes and truncated tetrahedra");
  for (const std::array<int, 3>& cuts : {std::array<int, 3>{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {2, 2, 2}, {3, 3, 3}}) {
    Scene whole = bed({"s2", Law::depth_potential, 2});
    whole.shapes[0] = cut_cube(0.01, cuts);
    const int parts = cuts[0] * cuts[1] * cuts[2];
    growth.add(parts, std::to_string(parts) + " parts", cost_of(whole));
  }
  return growth.result({});
}

CaseResult measure_faces() {
  Growth growth("faces", "faceted balls where S1 has spheres");
  for (const int corners : {8, 16, 32, 62}) {
    Scene whole = bed({"s1-box", Law::depth_potential, 1});
    // As many contacts as the spheres have, about: flat faces stand back behind the sphere of equal volume.
    whole.shapes = {benchmark_scenes::faceted_ball(corners, 1.01 * kSphere)};
    set_law_of_s2(whole);
    const std::size_t faces = std::get<dem_gpu::PolyhedralShape>(whole.shapes[0].geometry).parts[0].face_count();
    growth.add(static_cast<double>(faces), std::to_string(faces) + " faces", cost_of(whole));
  }
  return growth.result({});
}

CaseResult measure_contacts() {
  Growth growth("contacts", "spheres of S1 a little smaller or larger");
  for (const double scale : {0.98, 0.99, 1.0, 1.01, 1.02, 1.03}) {
    Scene whole = bed({"s1-box", Law::depth_potential, 2});
    for (dem_gpu::Body& body : whole.bodies) body.scale = scale;
    const BedCost cost = cost_of(whole);
    char name[32];
    std::snprintf(name, sizeof name, "%.2f times the size", scale);
    growth.add(cost.contacts, name, cost);
  }
  return growth.result({});
}

CaseResult measure_triangles() {
  Growth growth("triangles", "the floor of S1 as a mesh");
  for (const int cells : {1, 10, 100, 316}) {
    Scene whole = bed({"s1-box", Law::depth_potential, 2});
    make_floor_a_mesh(whole, cells);
    const int triangles = 2 * cells * cells;
    growth.add(triangles, std::to_string(triangles) + " triangles", cost_of(whole));
  }
  return growth.result({});
}

}  // namespace workflows
