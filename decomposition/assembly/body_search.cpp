// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/assembly/body_search.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "catalog/mass_properties.h"
#include "decomposition/assembly/part_gap.h"
#include "decomposition/geometry/box_heaps.h"
#include "decomposition/solid/round_frame.h"
#include "decomposition/solid/surface_pieces.h"

namespace decomposition {
namespace {

constexpr double kRoomForAPart = 1.3;  // volume and thickness of a body over those asked of a part

Vec3 centroid(const catalog::TriangleMesh& mesh) {
  const catalog::VolumeMoments moments = catalog::volume_moments(mesh);
  return (1 / moments.volume) * to_vec3(moments.first);
}

double thickness_of(const catalog::TriangleMesh& mesh) {
  std::vector<Vec3> points;
  for (const catalog::Point& p : mesh.vertices) points.push_back(to_vec3(p));
  return smallest_extent(points, RoundFrame(mesh));
}

bool meet(const FoundLevel& a, const FoundLevel& b) {
  return std::any_of(a.parts.begin(), a.parts.end(), [&](const BuiltPart& part) {
    return std::any_of(b.parts.begin(), b.parts.end(),
                       [&](const BuiltPart& other) { return !have_gap(part.part, other.part); });
  });
}

}  // namespace

BodySearch::BodySearch(const catalog::TriangleMesh& mesh, const DecompositionOptions& options)
    : mesh_(mesh), options_(options), volume_(catalog::volume_moments(mesh).volume) {
  find_bodies();
}

void BodySearch::find_bodies() {
  std::vector<Body> all;
  for (catalog::TriangleMesh& body : separate_bodies(mesh_)) {
    const double volume = catalog::volume_moments(body).volume, thickness = thickness_of(body);
    all.push_back({std::move(body), volume, thickness});
    largest_ = std::max(largest_, volume);
    thickest_ = std::max(thickest_, thickness);
  }
  std::vector<const Body*> small;
  std::vector<Vec3> centres;
  for (const Body& body : all) {
    const bool is_worth_a_part = body.volume >= kRoomForAPart * options_.smallest_volume * largest_ &&
                                 body.thickness >= kRoomForAPart * options_.smallest_thickness * thickest_;
    if (!is_worth_a_part) {
      small.push_back(&body);
      continue;
    }
    bodies_.push_back(body);
    centres.push_back(centroid(body.mesh));
  }
  if (bodies_.empty()) return;
  for (const Body* body : small) {
    const Vec3 centre = centroid(body->mesh);
    const auto nearest = std::min_element(centres.begin(), centres.end(), [&](const Vec3& a, const Vec3& b) {
      return norm(a - centre) < norm(b - centre);
    });
    Body& taker = bodies_[static_cast<std::size_t>(nearest - centres.begin())];
    add_mesh(body->mesh, taker.mesh);
    taker.volume += body->volume;
  }
}

int BodySearch::heaps() const {
  std::vector<Box> boxes;
  for (const Body& body : bodies_) boxes.push_back(bounding_box(body.mesh));
  return static_cast<int>(heaps_of(boxes).size());
}

BodySearch::Group BodySearch::all_bodies() const {
  Group all(bodies_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

LevelSearch& BodySearch::search_of(const Group& group) {
  if (const auto known = searches_.find(group); known != searches_.end()) return known->second;
  if (bodies() < 2) return searches_.try_emplace(group, mesh_, options_).first->second;
  // The smallest part is a share of the largest body, for all of them.
  DecompositionOptions options = options_;
  if (group == all_bodies()) {
    options.smallest_volume *= largest_ / volume_;
    return searches_.try_emplace(group, mesh_, options).first->second;
  }
  catalog::TriangleMesh mesh;
  for (const int body : group) add_mesh(bodies_[static_cast<std::size_t>(body)].mesh, mesh);
  options.smallest_volume *= largest_ / catalog::volume_moments(mesh).volume;
  options.smallest_thickness *= thickest_ / thickness_of(mesh);
  return searches_.try_emplace(group, mesh, options).first->second;
}

/// One part for each body, then one after the other where it is expected to gain most.
std::vector<int> BodySearch::shares(const std::vector<Group>& groups, int parts) {
  std::vector<int> result;
  for (const Group& group : groups) result.push_back(static_cast<int>(group.size()));
  for (int left = parts - static_cast<int>(bodies_.size()); left > 0; --left) {
    std::size_t best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t g = 0; g < groups.size(); ++g) {
      LevelSearch& search = search_of(groups[g]);
      const double gain = search.expected_misfit(result[g]) - search.expected_misfit(result[g] + 1);
      if (gain > most) best = g, most = gain;
    }
    ++result[best];
  }
  return result;
}

/// The groups with those in one whose parts meet; true if there are any.
bool BodySearch::merge_where_parts_meet(const std::vector<const FoundLevel*>& levels, std::vector<Group>& groups) {
  std::vector<std::size_t> first(groups.size());  // group that each goes with
  std::iota(first.begin(), first.end(), std::size_t{0});
  for (std::size_t a = 0; a < groups.size(); ++a)
    for (std::size_t b = a + 1; b < groups.size(); ++b)
      if (first[a] != first[b] && meet(*levels[a], *levels[b]))
        std::replace(first.begin(), first.end(), std::max(first[a], first[b]), std::min(first[a], first[b]));
  std::vector<Group> merged(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    merged[first[g]].insert(merged[first[g]].end(), groups[g].begin(), groups[g].end());
  std::erase_if(merged, [](const Group& group) { return group.empty(); });
  for (Group& group : merged) std::sort(group.begin(), group.end());
  return merged.size() < std::exchange(groups, merged).size();
}

FoundLevel BodySearch::searched(int parts_asked) {
  std::vector<Group> groups;
  if (parts_asked >= bodies())
    for (const int body : all_bodies()) groups.push_back({body});
  while (groups.size() > 1) {
    const std::vector<int> parts = shares(groups, parts_asked);
    std::vector<const FoundLevel*> levels;
    for (std::size_t g = 0; g < groups.size(); ++g) levels.push_back(&search_of(groups[g]).find(parts[g]));
    if (std::any_of(levels.begin(), levels.end(), [](const FoundLevel* level) { return level->parts.empty(); })) break;
    if (merge_where_parts_meet(levels, groups)) continue;
    FoundLevel level;
    for (const FoundLevel* of_group : levels) {
      level.parts.insert(level.parts.end(), of_group->parts.begin(), of_group->parts.end());
      level.keeps_rules = level.keeps_rules && of_group->keeps_rules;
      level.coverage.covered_area += of_group->coverage.covered_area;
      level.coverage.ledge_area += of_group->coverage.ledge_area;
    }
    return level;
  }
  return search_of(all_bodies()).find(parts_asked);
}

const FoundLevel& BodySearch::find(int parts_asked) {
  if (bodies() < 2) return search_of(all_bodies()).find(parts_asked);
  if (const auto known = levels_.find(parts_asked); known != levels_.end()) return known->second;
  FoundLevel level = searched(parts_asked);
  if (options_.mode != FitMode::volume_true && parts_asked > 1) {
    const FoundLevel& fewer = find(fewer_parts(parts_asked));
    level = nearer_to_bound(std::move(level), fewer, volume_);
  }
  return levels_[parts_asked] = std::move(level);
}

}  // namespace decomposition
