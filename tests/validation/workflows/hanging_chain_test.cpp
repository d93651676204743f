// SPDX-License-Identifier: Apache-2.0
// A hanging chain of rings: the period of its slowest small swing against that of a chain of rigid links, and a wide
// swing in which no link is lost.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "tests/support/dem_runs.h"
#include "tests/support/linked_rings.h"
#include "workflows/chain.h"
#include "workflows/ring_shape.h"

namespace {

using dem_gpu::Scene;
using dem_gpu::Simulation;
using dem_gpu::Vec3;
using test_support::Real;

constexpr double kGravity = 9.81, kDiameter = 0.04, kWire = 0.006;

/// Wire of three sides, an edge towards the hole: links cross in a point, which friction holds, so that a link turns
/// about points of its own. (Round wire rolls along the other, and a flat side rests on it.)
const dem_gpu::Shape& link() {
  static const dem_gpu::Shape shape = workflows::ring_shape("link", {kDiameter, kWire, 12, 3});
  return shape;
}
Vec3 ring_axis() { return workflows::link_hole(link(), "test").normal; }

/// The first ring held, `links` below it, taut; it hangs along -z.
Scene chain_scene(int links, Real restitution, Real friction) {
  workflows::ChainLayout layout;
  layout.links = links + 1;
  layout.gap = 0.002;
  layout.holds_first = true;
  Scene scene = test_support::empty_scene(restitution, friction);
  scene.gravity = {0, 0, -kGravity};
  // So stiff that the edges sink in by less than 1 % of the wire under the chain's weight.
  scene.polyhedral_law = dem_gpu::DepthPotential{1e11};
  scene.shapes = {link()};
  scene.bodies = workflows::chain_bodies(link(), layout, "chain");
  return scene;
}

/// Small planar swings of rigid links that turn about points `pitch` apart: M a'' + K a = 0 in the links' angles, which
/// are `a`. The joint above link i moves by pitch times the sum of the angles before it, its centre by pitch / 2 more.
struct LinkedPendulums {
  double pitch = 0;             // [m]
  double mass = 0;              // of a link [kg]
  std::vector<double> inertia;  // of each about its centre, about the axis of the swing [kg m2]

  double arm(std::size_t of, std::size_t to) const { return to < of ? pitch : to == of ? pitch / 2 : 0; }
  double stiffness(std::size_t i) const {
    double sum = 0;
    for (std::size_t k = 0; k < inertia.size(); ++k) sum += mass * kGravity * arm(k, i);
    return sum;
  }
  double inertia_between(std::size_t i, std::size_t j) const {
    double sum = i == j ? inertia[i] : 0;
    for (std::size_t k = 0; k < inertia.size(); ++k) sum += mass * arm(k, i) * arm(k, j);
    return sum;
  }

  struct Mode {
    std::vector<double> angles;  // the last is 1
    double period = 0;           // [s]
  };
  /// By inverse iteration on K^-1 M, whose largest eigenvalue is 1 / w^2.
  Mode slowest() const {
    const std::size_t n = inertia.size();
    Mode mode{std::vector<double>(n, 1), 0};
    for (int iteration = 0; iteration < 200; ++iteration) {
      std::vector<double> next(n);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) next[i] += inertia_between(i, j) * mode.angles[j];
        next[i] /= stiffness(i);
      }
      mode.period = 2 * std::numbers::pi * std::sqrt(next.back());
      for (std::size_t i = 0; i < n; ++i) mode.angles[i] = next[i] / next.back();
    }
    return mode;
  }
};

LinkedPendulums pendulums(const Scene& scene, const Simulation& simulation) {
  LinkedPendulums chain;
  chain.pitch = norm(scene.bodies[1].position - scene.bodies[0].position);
  chain.mass = simulation.geometry().body_mass[1];
  const double density = scene.materials[0].density;
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
    const Vec3 about = rotate(conjugate(scene.bodies[i].orientation), Vec3{0, 1, 0});  // the swing runs along x
    chain.inertia.push_back(density * dot(about, hadamard(link().principal_inertia, about)));
  }
  return chain;
}

/// Time between the first and the last crossing of the middle by the lowest link, over the periods between.
double measured_period(Simulation& simulation, double expected, int periods) {
  std::vector<double> crossings;
  double before = simulation.snapshot().position.back().x;
  while (static_cast<int>(crossings.size()) < 2 * periods + 1 && simulation.time() < (periods + 3) * expected) {
    simulation.advance(20);
    const double now = simulation.snapshot().position.back().x, span = 20 * simulation.time_step();
    if (before * now < 0) crossings.push_back(simulation.time() - span * now / (now - before));
    before = now;
  }
  return crossings.size() < 2 ? 0 : (crossings.back() - crossings.front()) / (0.5 * double(crossings.size() - 1));
}

TEST(HangingChain, SmallSwingHasThePeriodOfRigidLinks) {
  for (const int links : {1, 2, 4}) {
    const Scene scene = chain_scene(links, 0.3, 1);
    Simulation simulation(scene);
    const LinkedPendulums chain = pendulums(scene, simulation);
    const auto mode = chain.slowest();
    test_support::run_to(simulation, 0.03);  // taut, the slack of 12 um taken up
    constexpr double kAngle = 0.03;          // of the lowest link; 6e-5 longer than a swing of no width
    const double rate = kAngle * 2 * std::numbers::pi / mode.period;
    double joint = 0;
    for (std::size_t i = 0; i < mode.angles.size(); ++i) {
      const double turn = rate * mode.angles[i], speed = joint + turn * chain.pitch / 2;
      // A turn about -y swings what hangs below towards +x.
      simulation.push(static_cast<int>(i) + 1, {chain.mass * speed, 0, 0}, {0, -turn * chain.inertia[i], 0});
      joint += turn * chain.pitch;
    }
    const double period = measured_period(simulation, mode.period, 1);
    std::printf("  %d links on a held one: period %.5f s, of rigid links %.5f s\n", links, period, mode.period);
    // Edges that sink in and slide along each other by what the friction springs give way.
    EXPECT_NEAR(period / mode.period, 1, 0.005) << links << " links";
  }
}

TEST(HangingChain, WideSwingLosesNoLinkAndNoEnergy) {
  // Thrown to the side at up to 1.5 m/s: the chain whips, links jump and turn over.
  Scene scene = chain_scene(5, 0.5, 0.3);
  scene.polyhedral_law = dem_gpu::DepthPotential{1e10};
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) scene.bodies[i].velocity = {0.3 * double(i), 0.1, 0};
  Simulation simulation(scene);
  const Vec3 axis = ring_axis();
  for (int look = 1; look <= 10; ++look) {
    test_support::run_to(simulation, 0.1 * look);
    const auto now = simulation.snapshot();
    std::vector<std::vector<Vec3>> lines;
    for (std::size_t i = 0; i < now.position.size(); ++i)
      lines.push_back(test_support::ring_centreline(kDiameter, now.position[i], now.orientation[i], axis));
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_NEAR(std::abs(test_support::linking_number(lines[i], lines[j])), i - j == 1 ? 1 : 0, 1e-6)
            << "links " << j << " and " << i << " at " << simulation.time() << " s";
  }
  const auto ledger = simulation.ledger();
  std::printf("  wide swing of 5 links, 1 s: energy off by %.1e of what went in, %.0f %% dissipated\n",
              ledger.imbalance() / ledger.throughput, 100 * ledger.dissipated() / ledger.throughput);
  EXPECT_LT(std::abs(ledger.imbalance()), 0.01 * ledger.throughput);
  EXPECT_GT(ledger.dissipated(), 0);
}

}  // namespace
