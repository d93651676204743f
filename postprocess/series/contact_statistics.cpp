// SPDX-License-Identifier: Apache-2.0
#include "postprocess/contact_statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "catalog/input_error.h"

namespace postprocess {

Spread spread(std::vector<double> sample) {
  if (sample.empty()) return {};
  std::sort(sample.begin(), sample.end());
  const auto percentile = [&](double share) {
    const double place = share * static_cast<double>(sample.size() - 1);
    const std::size_t low = static_cast<std::size_t>(place);
    const std::size_t high = std::min(low + 1, sample.size() - 1);
    return sample[low] + (place - static_cast<double>(low)) * (sample[high] - sample[low]);
  };
  double sum = 0;
  for (const double value : sample) sum += value;
  return {sum / static_cast<double>(sample.size()), percentile(0.5), percentile(0.9), percentile(0.99), sample.back()};
}

double equivalent_diameter(const dem_gpu::RunGeometry& geometry, int body) {
  const dem_gpu::ShapeGeometry& shape = geometry.shapes[geometry.body_shape[body]];
  return geometry.body_scale[body] * std::cbrt(6 * shape.volume / std::numbers::pi);
}

void check_same_run(const dem_gpu::RunGeometry& geometry, const dem_gpu::Snapshot& snapshot) {
  const auto refuse = [](const std::string& what, std::size_t expected, std::size_t found) {
    throw catalog::InputError("snapshot and geometry.h5 are not of one run: geometry has " + std::to_string(expected) +
                              " " + what + ", the snapshot " + std::to_string(found));
  };
  if (snapshot.position.size() != geometry.body_shape.size())
    refuse("bodies", geometry.body_shape.size(), snapshot.position.size());
  if (snapshot.wall_rotation.size() != geometry.walls.size())
    refuse("walls", geometry.walls.size(), snapshot.wall_rotation.size());
}

ContactStatistics contact_statistics(const dem_gpu::RunGeometry& geometry, const dem_gpu::Snapshot& snapshot) {
  check_same_run(geometry, snapshot);
  ContactStatistics result;
  std::vector<double> forces, overlaps;
  std::set<std::pair<int, int>> neighbours;
  std::vector<char> touches(snapshot.position.size(), 0);
  for (const dem_gpu::SnapshotContact& contact : snapshot.contacts) {
    double diameter = equivalent_diameter(geometry, contact.body_a);
    touches[contact.body_a] = 1;
    if (contact.body_b >= 0) {
      ++result.body_contacts;
      touches[contact.body_b] = 1;
      neighbours.insert(std::minmax(contact.body_a, contact.body_b));
      diameter = std::min(diameter, equivalent_diameter(geometry, contact.body_b));
    } else {
      ++result.wall_contacts;
    }
    forces.push_back(dem_gpu::norm(contact.force));
    if (diameter > 0) overlaps.push_back(contact.overlap / diameter);
  }
  for (std::size_t b = 0; b < touches.size(); ++b) {
    if (!snapshot.active[b]) continue;
    ++result.active_bodies;
    if (!touches[b]) ++result.touching_nothing;
  }
  if (result.active_bodies > 0)
    result.coordination_number = 2.0 * static_cast<double>(neighbours.size()) / result.active_bodies;
  result.force = spread(std::move(forces));
  result.overlap = spread(std::move(overlaps));
  return result;
}

}  // namespace postprocess
