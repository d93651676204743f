// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmark/scenes/peer_files.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "catalog/input_error.h"

namespace benchmark_scenes {
namespace {

using catalog::InputError;
using dem_gpu::Scene;
using dem_gpu::Vec3;

constexpr int kAllDigits = 17;
constexpr double kMargin = 0.01;  // of the peers' domain about walls and bodies [m]

struct Bounds {
  Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  void include(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
};

bool is_drum(const Scene& scene) {
  return std::any_of(scene.walls.begin(), scene.walls.end(), [](const dem_gpu::Wall& wall) {
    return std::holds_alternative<dem_gpu::Cylinder>(wall.geometry);
  });
}

/// LAMMPS has cylinders about z alone.
Vec3 drum_frame(const Vec3& p) { return {p.z, p.x, p.y}; }

/// Of bodies, planes and the shell of a drum.
Bounds domain_of(const Scene& scene) {
  Bounds bounds;
  for (const dem_gpu::Body& body : scene.bodies) bounds.include(body.position);
  for (const dem_gpu::Wall& wall : scene.walls) {
    if (const auto* plane = std::get_if<dem_gpu::Plane>(&wall.geometry)) bounds.include(plane->point);
    if (const auto* shell = std::get_if<dem_gpu::Cylinder>(&wall.geometry))
      for (const double side : {-shell->radius, shell->radius}) bounds.include(shell->base + Vec3{side, 0, side});
  }
  const Vec3 margin{kMargin, kMargin, kMargin};
  return {bounds.low - margin, bounds.high + margin};
}

const dem_gpu::SphereShape& sphere_of(const Scene& scene, const dem_gpu::Body& body) {
  const auto* sphere = std::get_if<dem_gpu::SphereShape>(&scene.shapes[body.shape].geometry);
  if (!sphere) throw InputError("peer files: scene '" + scene.name + "' has bodies other than spheres");
  return *sphere;
}

void write_shape(std::ostream& out, const dem_gpu::Shape& shape) {
  if (const auto* sphere = std::get_if<dem_gpu::SphereShape>(&shape.geometry)) {
    out << "# sphere " << sphere->radius << "\n";
    return;
  }
  const auto& parts = std::get<dem_gpu::PolyhedralShape>(shape.geometry).parts;
  if (parts.size() != 1) throw InputError("peer files: shape '" + shape.name + "' has several parts");
  out << "#";
  for (const catalog::Point& vertex : parts.front().vertices)
    out << " " << vertex[0] << " " << vertex[1] << " " << vertex[2];
  out << "\n";
}

}  // namespace

std::string lammps_particles(const Scene& scene) {
  std::ostringstream out;
  out << std::setprecision(kAllDigits);
  const auto placed = [turns = is_drum(scene)](const Vec3& p) { return turns ? drum_frame(p) : p; };
  const Bounds domain = domain_of(scene);
  const Vec3 low = placed(domain.low), high = placed(domain.high);
  out << scene.name << "\n\n" << scene.bodies.size() << " atoms\n1 atom types\n";
  out << low.x << " " << high.x << " xlo xhi\n" << low.y << " " << high.y << " ylo yhi\n";
  out << low.z << " " << high.z << " zlo zhi\n\nAtoms\n\n";
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const dem_gpu::Body& body = scene.bodies[i];
    const Vec3 place = placed(body.position);
    out << i + 1 << " 1 " << 2 * sphere_of(scene, body).radius * body.scale << " "
        << scene.materials[body.material].density << " " << place.x << " " << place.y << " " << place.z << "\n";
  }
  return out.str();
}

std::string particle_table(const Scene& scene) {
  std::ostringstream out;
  out << std::setprecision(kAllDigits);
  for (const dem_gpu::Shape& shape : scene.shapes) write_shape(out, shape);
  for (const dem_gpu::Body& body : scene.bodies)
    out << body.shape << " " << body.position.x << " " << body.position.y << " " << body.position.z << " "
        << body.orientation.w << " " << body.orientation.x << " " << body.orientation.y << " " << body.orientation.z
        << "\n";
  return out.str();
}

}  // namespace benchmark_scenes
