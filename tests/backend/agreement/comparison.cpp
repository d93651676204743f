// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/agreement/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "tests/support/precision.h"

namespace agreement {
namespace {

using dem_gpu::Quaternion;
using dem_gpu::Snapshot;
using dem_gpu::Vec3;

/// Of one step. The integrals of a pair hold to kPairGoal (tests/property/dem_gpu), a body has some ten contacts; both
/// back ends round, each in its own order. Every further step adds as much.
constexpr double kStepTolerance = 10 * test_support::kPairGoal;

/// Student's t of two means of four seeds each (6 degrees of freedom) that chance exceeds once in a thousand cases.
constexpr double kLargestT = 5.96;
static_assert(std::size(kSeeds) == 4);

/// Below it seeds and back ends are alike: a difference of the measure over the measure itself.
constexpr double kSameBulk = 1e-9;

constexpr double kNever = std::numeric_limits<double>::infinity();

double distance(const Vec3& a, const Vec3& b) { return norm(a - b); }
double distance(const Quaternion& a, const Quaternion& b) {
  return std::hypot(std::hypot(a.w - b.w, a.x - b.x), std::hypot(a.y - b.y, a.z - b.z));
}

/// Largest difference of the columns over the reference's largest change since `start`.
template <class Value>
double difference(const std::vector<Value>& start, const std::vector<Value>& reference, const std::vector<Value>& own) {
  if (own.size() != reference.size() || start.size() != reference.size()) return kNever;
  double change = 0, apart = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    change = std::max(change, distance(reference[i], start[i]));
    const double d = distance(reference[i], own[i]);
    if (std::isnan(d)) return kNever;
    apart = std::max(apart, d);
  }
  return apart == 0 ? 0 : apart / change;
}

using PairForces = std::map<std::pair<int, int>, Vec3>;  // on the first body [N]

PairForces pair_forces(const Snapshot& snapshot) {
  PairForces forces;
  for (const dem_gpu::SnapshotContact& contact : snapshot.contacts)
    forces[{contact.body_a, contact.body_b}] += contact.force;
  return forces;
}

/// Over the largest force; a pair that touches on one side alone counts with all its force.
double force_difference(const Snapshot& reference, const Snapshot& own) {
  PairForces apart = pair_forces(reference);
  double largest = 0, worst = 0;
  for (const auto& [pair, force] : apart) largest = std::max(largest, norm(force));
  for (const auto& [pair, force] : pair_forces(own)) apart[pair] -= force;
  for (const auto& [pair, force] : apart) {
    if (std::isnan(norm(force))) return kNever;
    worst = std::max(worst, norm(force));
  }
  return worst == 0 ? 0 : worst / largest;
}

void compare_steps(const Snapshot& start, const Snapshot& reference, const Snapshot& own, int steps,
                   std::vector<Agreement>& rows) {
  const std::string after = steps == 1 ? ", one step" : ", " + std::to_string(steps) + " steps";
  const auto add = [&](const std::string& what, double apart) {
    rows.push_back({what + after, apart, steps * kStepTolerance});
  };
  add("position", difference(start.position, reference.position, own.position));
  add("orientation", difference(start.orientation, reference.orientation, own.orientation));
  add("velocity", difference(start.velocity, reference.velocity, own.velocity));
  add("angular velocity", difference(start.angular_velocity, reference.angular_velocity, own.angular_velocity));
  add("contact force", force_difference(reference, own));
}

/// Mean and variance over the seeds.
std::array<double, 2> moments(const std::vector<Bulk>& bulks, double Bulk::*measure) {
  double mean = 0, variance = 0;
  const double n = static_cast<double>(bulks.size());
  for (const Bulk& bulk : bulks) mean += bulk.*measure / n;
  for (const Bulk& bulk : bulks) variance += (bulk.*measure - mean) * (bulk.*measure - mean) / (n - 1);
  return {mean, variance};
}

/// Student's t of the two means.
double student_t(const Outcome& reference, const Outcome& own, double Bulk::*measure) {
  const auto [mean, variance] = moments(reference.bulks, measure);
  const auto [own_mean, own_variance] = moments(own.bulks, measure);
  const double apart = std::abs(own_mean - mean);
  if (apart <= kSameBulk * std::abs(mean)) return 0;
  return apart / std::sqrt((variance + own_variance) / static_cast<double>(std::size(kSeeds)));
}

}  // namespace

std::vector<Agreement> compare(const Outcome& reference, const Outcome& own) {
  std::vector<Agreement> rows;
  compare_steps(reference.start, reference.after_one, own.after_one, 1, rows);
  compare_steps(reference.start, reference.after_many, own.after_many, kManySteps, rows);
  rows.push_back({"kinetic energy, t", student_t(reference, own, &Bulk::kinetic_energy), kLargestT});
  rows.push_back({"mean height, t", student_t(reference, own, &Bulk::mean_height), kLargestT});
  rows.push_back({"coordination, t", student_t(reference, own, &Bulk::coordination), kLargestT});
  return rows;
}

}  // namespace agreement
