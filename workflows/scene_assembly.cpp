// SPDX-License-Identifier: Apache-2.0
#include "workflows/scene_assembly.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "catalog/input_error.h"
#include "workflows/fill_shapes.h"
#include "workflows/initial_state.h"
#include "workflows/random_stream.h"
#include "workflows/scene_sections.h"

namespace workflows {
namespace {

using dem_gpu::Body;
using dem_gpu::Scene;

constexpr double kMostBodies = 5e6;
// Stream numbers of a fill's seed; placing uses stream 0.
constexpr std::uint64_t kShapeStream = 1;
// A body may reach this share of its radius into a wall at the start: rounding where a region ends at the wall.
constexpr double kWallTolerance = 1e-6;

bool is_sphere(const Scene& scene, const Body& body) {
  return std::holds_alternative<dem_gpu::SphereShape>(scene.shapes[static_cast<std::size_t>(body.shape)].geometry);
}

double mass_of(const Scene& scene, const Body& body) {
  return scene.materials[static_cast<std::size_t>(body.material)].density *
         scene.shapes[static_cast<std::size_t>(body.shape)].volume * body.scale * body.scale * body.scale;
}

/// How many bodies make up the amount asked for.
int body_count(const FillDescription& fill, const std::vector<FillShape>& shapes, double density) {
  if (const auto* count = std::get_if<std::int64_t>(&fill.amount)) return static_cast<int>(*count);
  const double asked = std::get<double>(fill.amount);
  double mean_volume = 0;
  for (const FillShape& shape : shapes) {
    const double size_cubed = shape.size * shape.size * shape.size;
    mean_volume += shape.volume * (fill.size ? mean_cubed_size(*fill.size) / size_cubed : 1) / double(shapes.size());
  }
  const double count = std::round(asked / (density * mean_volume));
  if (count > kMostBodies)
    throw catalog::InputError(fill.place + ": mass is " + std::to_string(count) +
                              " bodies, too many; check the units of mass and sizes");
  return std::max(1, static_cast<int>(count));
}

/// Bodies of a fill, not placed yet. Sizes ascend, and each run of as many bodies as there are shapes holds every shape
/// once, so that shape and size stay independent.
std::vector<Body> sampled_bodies(const FillDescription& fill, std::vector<FillShape> shapes, double density) {
  const int count = body_count(fill, shapes, density);
  const std::vector<double> sizes = fill.size ? sample_sizes(*fill.size, count) : std::vector<double>{};
  RandomStream random(fill.layout.seed, kShapeStream);
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    if (i % shapes.size() == 0) random.shuffle(shapes);
    const FillShape& shape = shapes[i % shapes.size()];
    Body body;
    body.shape = shape.index;
    body.material = fill.material;
    body.scale = sizes.empty() ? 1 : sizes[i] / shape.size;
    body.velocity = to_vec3(fill.velocity);
    bodies.push_back(body);
  }
  return bodies;
}

/// Adds the fills' bodies to the scene, unplaced, and reports their sizes.
void add_bodies(const SceneDescription& description, ShapeCollector& collector, AssembledScene& assembled,
                std::vector<InitialBall>& balls) {
  Scene& scene = assembled.scene;
  for (const FillDescription& fill : description.fills) {
    const std::vector<FillShape> shapes = collector.shapes_of(fill);
    const double density = scene.materials[static_cast<std::size_t>(fill.material)].density;
    FillReport report;
    report.name = fill.name;
    report.first_body = static_cast<int>(scene.bodies.size());
    std::vector<double> sizes, masses;
    for (const Body& body : sampled_bodies(fill, shapes, density)) {
      const auto shape =
          std::find_if(shapes.begin(), shapes.end(), [&](const FillShape& one) { return one.index == body.shape; });
      sizes.push_back(shape->size * body.scale);
      masses.push_back(mass_of(scene, body));
      report.mass += masses.back();
      balls.push_back({{}, shape->bounding_radius * body.scale, 0});
      scene.bodies.push_back(body);
    }
    report.bodies = static_cast<int>(sizes.size());
    report.realised = realised_sizes(sizes, masses);
    assembled.fills.push_back(std::move(report));
  }
}

/// The shape of a chain's links: one, whatever the query may find.
FillShape link_shape(const ChainDescription& chain, ShapeCollector& collector) {
  FillDescription source;
  source.place = chain.place;
  source.shapes = chain.link;
  const std::vector<FillShape> shapes = collector.shapes_of(source);
  if (shapes.size() > 1)
    throw catalog::InputError(chain.place + ": select finds " + std::to_string(shapes.size()) +
                              " shapes; a chain has links of one, so narrow the query");
  return shapes.front();
}

/// Adds the chains' links, placed. The engine's own check at the start finds those that reach into a wall or each
/// other.
void add_chains(const SceneDescription& description, ShapeCollector& collector, AssembledScene& assembled,
                std::vector<InitialBall>& balls) {
  Scene& scene = assembled.scene;
  const int group = static_cast<int>(description.fills.size());
  for (const ChainDescription& chain : description.chains) {
    const FillShape link = link_shape(chain, collector);
    ChainReport report{chain.name, static_cast<int>(scene.bodies.size()), chain.layout.links, 0};
    for (Body& body : chain_bodies(scene.shapes[static_cast<std::size_t>(link.index)], chain.layout, chain.place)) {
      body.shape = link.index;
      body.material = chain.material;
      if (!body.is_fixed) body.velocity = to_vec3(chain.velocity);
      report.mass += mass_of(scene, body);
      balls.push_back({body.position, link.bounding_radius, group});
      scene.bodies.push_back(body);
    }
    assembled.chains.push_back(report);
  }
}

/// Fills of one and the same region are laid out together, mixed; the first one's layout holds.
void place_bodies(const SceneDescription& description, AssembledScene& assembled, std::vector<InitialBall>& balls) {
  const dem_gpu::Vec3 up = -unit_or(assembled.scene.gravity, {0, 0, -1});
  const auto& fills = description.fills;
  std::vector<char> is_placed(fills.size(), 0);
  for (std::size_t first = 0; first < fills.size(); ++first) {
    if (is_placed[first]) continue;
    std::vector<std::size_t> bodies;
    std::vector<double> radii;
    for (std::size_t fill = first; fill < fills.size(); ++fill) {
      if (!(fills[fill].region == fills[first].region)) continue;
      is_placed[fill] = 1;
      for (int i = 0; i < assembled.fills[fill].bodies; ++i) {
        bodies.push_back(static_cast<std::size_t>(assembled.fills[fill].first_body + i));
        balls[bodies.back()].group = static_cast<int>(first);
        radii.push_back(balls[bodies.back()].radius);
      }
    }
    const std::vector<Placement> placements =
        fill_region(fills[first].region, radii, fills[first].layout, to_point(up), fills[first].place);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Body& body = assembled.scene.bodies[bodies[i]];
      const auto [w, x, y, z] = placements[i].orientation;
      body.position = balls[bodies[i]].centre = to_vec3(placements[i].position);
      body.orientation = {w, x, y, z};
    }
  }
}

void refuse_bad_start(const SceneDescription& description, const AssembledScene& assembled,
                      const std::vector<InitialBall>& balls) {
  std::vector<std::string> names;
  for (const FillDescription& fill : description.fills) names.push_back("fill \"" + fill.name + "\"");
  names.push_back("a chain");
  if (const std::string line = overlapping_balls(balls, names); !line.empty())
    throw catalog::InputError(description.file.string() + ": " + line);
  for (std::size_t fill = 0; fill < description.fills.size(); ++fill)
    for (const dem_gpu::Wall& wall : assembled.scene.walls) {
      const WallReach wall_reach(wall);
      for (int i = 0; i < assembled.fills[fill].bodies; ++i) {
        const InitialBall& ball = balls[static_cast<std::size_t>(assembled.fills[fill].first_body + i)];
        const double reach = wall_reach.reach_of(ball.centre, ball.radius);
        if (reach <= kWallTolerance * ball.radius) continue;
        char depth[32];
        std::snprintf(depth, sizeof depth, "%.3g mm", reach * 1e3);
        throw catalog::InputError(description.fills[fill].place + ": a body's bounding ball reaches " + depth +
                                  " into wall \"" + wall.name + "\" at the start; shrink or move the region");
      }
    }
}

/// Stiffness of a linear spring for which the heaviest sphere, striking a wall at `speed`, sinks in by
/// `largest_overlap` of its diameter: m v^2 = k d^2.
double sphere_stiffness(const Scene& scene, double speed, double largest_overlap) {
  double stiffness = 0;
  for (const Body& body : scene.bodies) {
    if (!is_sphere(scene, body)) continue;
    const auto& shape = scene.shapes[static_cast<std::size_t>(body.shape)];
    const double depth = largest_overlap * 2 * std::get<dem_gpu::SphereShape>(shape.geometry).radius * body.scale;
    stiffness = std::max(stiffness, mass_of(scene, body) * speed * speed / (depth * depth));
  }
  return stiffness;
}

void set_stiffness(const SceneDescription& description, Scene& scene) {
  const StiffnessChoice& choice = description.stiffness;
  const auto sphere = [&](const Body& body) { return is_sphere(scene, body); };
  const bool has_spheres = std::any_of(scene.bodies.begin(), scene.bodies.end(), sphere);
  const bool has_polyhedra = !std::all_of(scene.bodies.begin(), scene.bodies.end(), sphere);
  const std::string file = description.file.string();

  double polyhedra = choice.polyhedra.value_or(0);
  if (has_polyhedra && !choice.polyhedra) {
    if (!choice.largest_overlap)
      throw catalog::InputError(file +
                                ": contact_law: stiffness of polyhedra is missing; state stiffness = \"2e7 N/m3\""
                                " or largest_overlap with at_speed");
    polyhedra = dem_gpu::stiffness_for_overlap(scene, choice.at_speed, *choice.largest_overlap, choice.overlap_at);
  }
  std::visit([&](auto& law) { law.stiffness = polyhedra; }, scene.polyhedral_law);
  if (auto* hardening = std::get_if<dem_gpu::HardeningDepthPotential>(&scene.polyhedral_law);
      hardening && has_polyhedra && choice.largest_overlap)
    hardening->flat_overlap = dem_gpu::flat_overlap(scene, choice.at_speed);

  if (auto* spring = std::get_if<dem_gpu::LinearSpring>(&scene.sphere_law)) {
    if (has_spheres && !choice.spheres && !choice.largest_overlap)
      throw catalog::InputError(file +
                                ": contact_law: stiffness of spheres is missing; state sphere_stiffness = "
                                "\"1e5 N/m\" or largest_overlap with at_speed");
    spring->stiffness = choice.spheres.value_or(
        choice.largest_overlap ? sphere_stiffness(scene, choice.at_speed, *choice.largest_overlap) : 0);
  }
}

}  // namespace

AssembledScene assemble_scene(const SceneDescription& description) {
  AssembledScene assembled;
  assembled.scene = description.scene;
  std::vector<InitialBall> balls;  // as Scene::bodies
  ShapeCollector collector(assembled);
  add_bodies(description, collector, assembled, balls);
  place_bodies(description, assembled, balls);
  add_chains(description, collector, assembled, balls);
  refuse_bad_start(description, assembled, balls);
  set_stiffness(description, assembled.scene);
  return assembled;
}

}  // namespace workflows
