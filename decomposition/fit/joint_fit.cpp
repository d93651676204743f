// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/joint_fit.h"

#include <algorithm>

#include "decomposition/fit/bumps.h"
#include "decomposition/fit/face_forces.h"
#include "decomposition/fit/leaf_shape.h"
#include "decomposition/fit/part_fit.h"

namespace decomposition {
namespace {

constexpr double kMomentum = 0.6;
constexpr int kReviveEvery = 12;       // steps between putting back corners that fell inside
constexpr double kReviveUntil = 0.85;  // share of the steps
constexpr double kVolumeGain = 0.4;    // of the integral steering of the volume, per step and relative volume error
constexpr double kLargestSteering = 0.5;
constexpr double kSteepest = 0.3;     // sine between an edge and the cut it ends on, below which its motion is damped
constexpr double kTurningArm = 0.1;   // share of the diagonal: holds cuts with small sections from turning fast
constexpr double kHeldOffFrom = 1.5;  // times the smallest volume a part may have: where cuts begin to draw back
constexpr double kHoldingOff = 1.5, kMostHoldingOff = 0.5;  // their push per relative lack of volume, and at most
constexpr double kHoldOffAfter = 0.25;  // share of the steps: before, parts are still growing into their cells
constexpr int kProjectionPasses = 25;

class JointFitter {
 public:
  JointFitter(const Solid& solid, Partition& partition, const JointPlan& plan)
      : solid_(solid), partition_(partition), plan_(plan), random_(plan.seed) {}

  bool run() {
    start();
    if (!update()) return false;
    const double decay = std::pow(plan_.last_step / plan_.first_step, 1.0 / std::max(1, plan_.steps - 1));
    double step = plan_.first_step * solid_.diagonal();
    for (int s = 0; s < plan_.steps; ++s, step *= decay) {
      if (plan_.revives && s < kReviveUntil * plan_.steps && s % kReviveEvery == kReviveEvery - 1) {
        revive();
        if (!update()) return false;
      }
      gather(s >= kHoldOffAfter * plan_.steps);
      move(step);
      if (!update()) return false;
      steer_volume(s);
    }
    return true;
  }

 private:
  using Corners = std::vector<std::vector<Vec3>>;

  void start() {
    shapes_.resize(partition_.leaves.size());
    forces_.resize(partition_.leaves.size());
    for (const Leaf& leaf : partition_.leaves) own_velocity_.emplace_back(leaf.points.size());
    for (const Section& section : partition_.sections) corner_velocity_.emplace_back(section.corners.size());
    cut_velocity_.assign(partition_.cuts.size(), {});
    cut_spin_.assign(partition_.cuts.size(), {});
  }

  bool update() {
    sections_.build(partition_, kSameCorner * solid_.diagonal());
    middles_.resize(partition_.sections.size());
    for (std::size_t s = 0; s < middles_.size(); ++s) {
      const std::vector<int>& polygon = sections_.polygon(static_cast<int>(s));
      if (polygon.empty()) continue;
      middles_[s] = {};
      for (const int node : polygon)
        middles_[s] +=
            (1.0 / static_cast<double>(polygon.size())) * sections_.nodes()[static_cast<std::size_t>(node)].place;
    }
    for (std::size_t a = 0; a < shapes_.size(); ++a)
      if (!shapes_[a].update(partition_, partition_.leaves[a], sections_, solid_.diagonal())) return false;
    return true;
  }

  /// Forces on all own points and, through the sections, on the free corners of the cuts.
  void gather(bool holds_off) {
    const ForceSampling sampling{plan_.samples_along, plan_.rock_weight, true, steering_};
    node_force_.assign(sections_.nodes().size(), {});
    node_share_.assign(sections_.nodes().size(), 0.0);
    node_spread_.assign(sections_.nodes().size(), {});
    votes_.assign(partition_.cuts.size(), {});
    for (std::size_t a = 0; a < shapes_.size(); ++a) {
      LeafShape& shape = shapes_[a];
      gather_forces(
          solid_, shape.points, shape.hull.faces(), sampling, random_,
          [&](const auto& face) { return shape.is_on_one_cut(face); }, forces_[a]);
      if (plan_.spread > 0) push_apart(a);
      if (plan_.smallest_part > 0 && holds_off) hold_cuts_off(a);
      const std::size_t own = shape.own_count();
      for (std::size_t k = 0; k < shape.nodes.size(); ++k) {
        const auto node = static_cast<std::size_t>(shape.nodes[k]);
        node_force_[node] += forces_[a].force[own + k];
        node_share_[node] += forces_[a].share[own + k];
      }
    }
    pass_forces_on();
  }

  /// Pushes own points and own corners of sections off one another and off the longest edges of flat triangles, the
  /// harder the nearer. The cuts do not follow.
  void push_apart(std::size_t a) {
    const LeafShape& shape = shapes_[a];
    const double size = shape.size(), shortest = plan_.shortest_edge * size, narrowest = plan_.narrowest_face * size;
    const auto at = [&](int v) -> const Vec3& { return shape.points[static_cast<std::size_t>(v)]; };
    const auto push = [&](int v, const Vec3& way) {
      const std::size_t vertex = static_cast<std::size_t>(v), own = shape.own_count();
      const Vec3 force = (plan_.spread * forces_[a].share[vertex]) * way;
      if (vertex < own)
        forces_[a].force[vertex] += force;
      else if (const auto node = static_cast<std::size_t>(shape.nodes[vertex - own]); sections_.nodes()[node].is_free())
        node_spread_[node] += force;
    };
    for (const auto& face : shape.hull.faces()) {
      double longest = 0;
      std::size_t base = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const int from = face[k], to = face[(k + 1) % 3];
        const Vec3 edge = at(to) - at(from);
        const double length = norm(edge);
        if (length > longest) longest = length, base = k;
        if (from > to || length >= shortest || length == 0) continue;  // every edge once
        const Vec3 way = ((1 - length / shortest) / length) * edge;
        push(from, -way);
        push(to, way);
      }
      if (longest == 0 || shape.is_on_one_cut(face)) continue;
      const int from = face[base], to = face[(base + 1) % 3], apex = face[(base + 2) % 3];
      const Vec3 along = (1 / longest) * (at(to) - at(from)), arm = at(apex) - at(from);
      const Vec3 up = arm - dot(arm, along) * along;
      const double height = norm(up);
      if (height >= narrowest || height == 0) continue;
      const Vec3 way = ((1 - height / narrowest) / height) * up;
      push(apex, way);
      push(from, -0.5 * way);
      push(to, -0.5 * way);
    }
  }

  /// Cuts around a part that is nearly too small give way to it.
  void hold_cuts_off(std::size_t a) {
    const LeafShape& shape = shapes_[a];
    const double lack = 1 - shape.hull.volume() / (kHeldOffFrom * plan_.smallest_part);
    if (lack <= 0) return;
    const std::vector<CutSide>& sides = partition_.leaves[a].sides;
    for (std::size_t v = shape.own_count(); v < shape.points.size(); ++v)
      for (std::size_t s = 0; s < sides.size(); ++s) {
        if (!(shape.on_cut[v] >> (s % 64) & 1) || forces_[a].share[v] <= 0) continue;
        const double push = std::fmin(kMostHoldingOff, kHoldingOff * lack) * forces_[a].share[v];
        votes_[static_cast<std::size_t>(sides[s].cut)].push_back(
            {shape.points[v], sides[s].is_reversed ? -push : push, forces_[a].share[v]});
      }
  }

  /// Hands the forces on derived nodes to the nodes that they come from, last made first, and collects what pushes each
  /// cut along its normal.
  void pass_forces_on() {
    const std::vector<SectionNode>& nodes = sections_.nodes();
    for (std::size_t n = nodes.size(); n-- > 0;) {
      const SectionNode& node = nodes[n];
      if (node_share_[n] <= 0) continue;
      const Vec3& normal = partition_.cuts[static_cast<std::size_t>(node.cut)].plane.normal;
      if (node.is_free()) {
        votes_[static_cast<std::size_t>(node.cut)].push_back({node.place, dot(node_force_[n], normal), node_share_[n]});
        continue;
      }
      const auto from = static_cast<std::size_t>(node.from), to = static_cast<std::size_t>(node.to);
      const Vec3 edge = normalized(nodes[to].place - nodes[from].place);
      const double sine = dot(normal, edge);
      const double slide = dot(edge, node_force_[n]) * sine / std::fmax(sine * sine, kSteepest * kSteepest);
      votes_[static_cast<std::size_t>(node.cut)].push_back({node.place, slide, node_share_[n]});
      const Vec3 force = node_force_[n] - slide * normal;  // the node stays on the cut while its ends move
      node_force_[from] += (1 - node.share) * force;
      node_force_[to] += node.share * force;
      node_share_[from] += (1 - node.share) * node_share_[n];
      node_share_[to] += node.share * node_share_[n];
    }
  }

  void move(double step) {
    if (plan_.cut_rate > 0) move_cuts(plan_.cut_rate * step);
    const std::vector<SectionNode>& nodes = sections_.nodes();
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (nodes[n].is_free() && node_share_[n] > 0) {
        const auto s = static_cast<std::size_t>(nodes[n].section), k = static_cast<std::size_t>(nodes[n].corner);
        Vec3& velocity = corner_velocity_[s][k];
        velocity = kMomentum * velocity + ((1 - kMomentum) / node_share_[n]) * (node_force_[n] + node_spread_[n]);
        put_corner(s, k, partition_.sections[s].corners[k] + step * velocity);
      }
    for (std::size_t a = 0; a < shapes_.size(); ++a) {
      for (std::size_t v = 0; v < own_velocity_[a].size(); ++v) {
        if (forces_[a].share[v] <= 0) continue;
        Vec3& velocity = own_velocity_[a][v];
        velocity = kMomentum * velocity + ((1 - kMomentum) / forces_[a].share[v]) * forces_[a].force[v];
        put_own(a, v, partition_.leaves[a].points[v] + step * velocity);
      }
    }
  }

  /// Each cut follows the corners on it, as far as one plane can: the motion (shift and turn) nearest to what each
  /// corner would do alone, by least squares with the corners' area shares as weights.
  void move_cuts(double step) {
    for (std::size_t c = 0; c < partition_.cuts.size(); ++c) {
      const std::vector<Vote>& votes = votes_[c];
      double area = 0, shift = 0, spread = 0;
      Vec3 middle;
      for (const Vote& vote : votes) area += vote.share, middle += vote.share * vote.place;
      if (!(area > 0)) continue;
      middle = (1 / area) * middle;
      Plane& plane = partition_.cuts[c].plane;
      Vec3 turn;
      for (const Vote& vote : votes) {
        const double push = std::clamp(vote.push / vote.share, -1.0, 1.0) * vote.share;
        const Vec3 arm = vote.place - middle;
        shift += push / area;
        turn += push * arm;
        spread += vote.share * dot(arm, arm);
      }
      if (!(spread > 0)) continue;
      // In the plane both second moments are about half the polar one.
      const double arm = kTurningArm * solid_.diagonal();
      const Vec3 tilt = (2 / (spread + area * arm * arm)) * (turn - dot(turn, plane.normal) * plane.normal);
      cut_velocity_[c] = kMomentum * cut_velocity_[c] + (1 - kMomentum) * shift;
      cut_spin_[c] = kMomentum * cut_spin_[c] + (1 - kMomentum) * tilt;
      const Vec3 pivot = middle + (step * cut_velocity_[c]) * plane.normal;
      plane.normal = normalized(plane.normal - step * cut_spin_[c]);
      plane.offset = dot(plane.normal, pivot);
    }
    for (std::size_t s = 0; s < partition_.sections.size(); ++s)
      for (std::size_t k = 0; k < partition_.sections[s].corners.size(); ++k)
        put_corner(s, k, partition_.sections[s].corners[k]);
    for (std::size_t a = 0; a < shapes_.size(); ++a) {
      shapes_[a].cell = partition_.planes_of(partition_.leaves[a].sides);
      for (std::size_t v = 0; v < partition_.leaves[a].points.size(); ++v)
        put_own(a, v, partition_.leaves[a].points[v]);
    }
  }

  void put_own(std::size_t leaf, std::size_t v, const Vec3& place) {
    // A margin for each, so that points pressed against a cut do not end up in one plane.
    const double golden = 0.6180339887498949 * static_cast<double>(v + 1);
    const double margin = kOwnMargin * solid_.diagonal() * (1 + 0.5 * (golden - std::floor(golden)));
    partition_.leaves[leaf].points[v] = project_into_cell(place, shapes_[leaf].cell, shapes_[leaf].centre, margin);
  }

  /// An own corner of a section at the place in the plane of its cut and inside the cell that the cut divides.
  void put_corner(std::size_t s, std::size_t k, Vec3 place) {
    Section& section = partition_.sections[s];
    const Cut& cut = partition_.cut_of(section);
    const double margin = kOwnMargin * solid_.diagonal();
    place -= cut.plane.signed_distance(place) * cut.plane.normal;
    Vec3 inside = place;
    for (int pass = 0; pass < kProjectionPasses; ++pass) {
      bool is_inside = true;
      for (const CutSide& side : cut.sides) {
        const Plane plane = partition_.plane_of(side);
        const double excess = plane.signed_distance(inside) + margin;
        if (excess <= 1e-3 * margin) continue;
        is_inside = false;
        const Vec3 along = plane.normal - dot(plane.normal, cut.plane.normal) * cut.plane.normal;
        if (const double length = dot(along, along); length > kSteepest * kSteepest)
          inside -= (excess / length) * along;
      }
      if (is_inside) {
        section.corners[k] = inside;
        return;
      }
    }
    // No way in the plane that is short: towards the middle of the section, certain to end in the cell.
    const Vec3 middle = middles_[s] - cut.plane.signed_distance(middles_[s]) * cut.plane.normal;
    double share = 1;
    for (const CutSide& side : cut.sides) {
      const Plane plane = partition_.plane_of(side);
      const double depth = -plane.signed_distance(middle) - margin, reach = dot(plane.normal, place - middle);
      if (reach > depth) share = std::fmin(share, std::fmax(0.0, depth) / reach);
    }
    section.corners[k] = middle + share * (place - middle);
  }

  void steer_volume(int step) {
    if (plan_.volume <= 0 || step < 0.2 * plan_.steps) return;
    double volume = 0;
    for (const LeafShape& shape : shapes_) volume += shape.hull.volume();
    steering_ += std::clamp(kVolumeGain * (volume / plan_.volume - 1), -0.05, 0.05);
    steering_ = std::clamp(steering_, -kLargestSteering, kLargestSteering);
  }

  void revive() {
    for (std::size_t a = 0; a < shapes_.size(); ++a) revive_own(a);
    for (std::size_t s = 0; s < partition_.sections.size(); ++s) revive_corners(s);
  }

  /// Puts own points that fell inside on the faces with most rock outside, half-way up.
  void revive_own(std::size_t a) {
    const LeafShape& shape = shapes_[a];
    std::vector<std::size_t> dead;
    for (std::size_t v = 0; v < own_velocity_[a].size(); ++v)
      if (!shape.hull.is_vertex(static_cast<int>(v))) dead.push_back(v);
    if (dead.empty()) return;
    const std::vector<Vec3> places =
        bump_places(solid_, shape.points, shape.hull.faces(), shape.cell, kOwnMargin * solid_.diagonal(), dead.size(),
                    [&](const auto& face) { return shape.is_on_one_cut(face); });
    for (std::size_t k = 0; k < places.size(); ++k) {
      put_own(a, dead[k], places[k]);
      own_velocity_[a][dead[k]] = {};
    }
  }

  /// Puts free corners that are no corners of their section at the middle of its longest outer edges.
  void revive_corners(std::size_t s) {
    const std::vector<Vec3>& corners = partition_.sections[s].corners;
    const std::vector<int>& polygon = sections_.polygon(static_cast<int>(s));
    if (polygon.size() < 3) return;
    std::vector<char> is_alive(corners.size(), 0);
    const auto node = [&](std::size_t k) {
      return sections_.nodes()[static_cast<std::size_t>(polygon[k % polygon.size()])];
    };
    Vec3 middle;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      middle += (1.0 / static_cast<double>(polygon.size())) * node(k).place;
      if (node(k).section == static_cast<int>(s)) is_alive[static_cast<std::size_t>(node(k).corner)] = 1;
    }
    for (std::size_t dead = 0; dead < is_alive.size(); ++dead) {
      if (is_alive[dead]) continue;
      double longest = 0;
      Vec3 place = corners[dead];
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3 from = node(k).place, to = node(k + 1).place;
        const bool is_inner = !node(k).is_free() && !node(k + 1).is_free();
        const Vec3 half = 0.5 * (from + to);
        const bool is_taken = std::any_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
          return norm(corner - half) < 0.1 * norm(to - from);
        });
        if (!is_inner && !is_taken && norm(to - from) > longest) {
          longest = norm(to - from);
          place = half + (0.02 * longest / norm(half - middle)) * (half - middle);
        }
      }
      put_corner(s, dead, place);
      corner_velocity_[s][dead] = {};
    }
  }

  struct Vote {
    Vec3 place;
    double push;   // force along the cut's normal
    double share;  // area
  };

  const Solid& solid_;
  Partition& partition_;
  const JointPlan& plan_;
  Random random_;
  SectionPolygons sections_;
  std::vector<Vec3> middles_;  // of the sections
  std::vector<LeafShape> shapes_;
  std::vector<VertexForces> forces_;
  Corners own_velocity_, corner_velocity_;
  std::vector<double> cut_velocity_;  // along the normal
  std::vector<Vec3> cut_spin_;        // slope of the motion in the plane
  std::vector<Vec3> node_force_, node_spread_;
  std::vector<double> node_share_;
  std::vector<std::vector<Vote>> votes_;
  double steering_ = 0;  // multiplier of the volume: positive pushes inward
};

}  // namespace

bool fit_jointly(const Solid& solid, Partition& partition, const JointPlan& plan) {
  return JointFitter(solid, partition, plan).run();
}

}  // namespace decomposition
