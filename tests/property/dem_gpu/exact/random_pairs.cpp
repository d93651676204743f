// SPDX-License-Identifier: Apache-2.0
#include "tests/property/dem_gpu/exact/random_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/dem_scenes.h"

namespace exact {
namespace {

using catalog::ConvexPart;
using dem_gpu::axis_angle;
using dem_gpu::BodyPose;
using dem_gpu::PosePair;
using dem_gpu::Quaternion;
using dem_gpu::Vec3;
using test_support::random_convex_part;
using test_support::random_direction;
using test_support::random_rotation;
using test_support::to_vec3;

constexpr double kAspect = 50;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
int pick(Random& random, int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); }
/// Exponents spread evenly.
double log_uniform(Random& random, double low, double high) {
  return std::exp(uniform(random, std::log(low), std::log(high)));
}

ConvexPart random_box(Random& random) {
  return dem_gpu::box_part({uniform(random, 0.3, 1.5), uniform(random, 0.3, 1.5), uniform(random, 0.3, 1.5)});
}
ConvexPart random_hull(Random& random, const Vec3& half = {1, 1, 1}) {
  return random_convex_part(random, 4 + pick(random, 29), half);
}
ConvexPart random_body(Random& random) {
  switch (pick(random, 4)) {
    case 0:
      return test_support::unit_cube();
    case 1:
      return random_box(random);
    case 2:
      return test_support::tetrahedron(1.5);
    default:
      return random_hull(random);
  }
}
ConvexPart needle(Random& random) {
  return pick(random, 2) ? dem_gpu::box_part({2, 2 / kAspect, 2 / kAspect})
                         : random_hull(random, {1, 1 / kAspect, 1 / kAspect});
}
ConvexPart plate(Random& random) {
  return pick(random, 2) ? dem_gpu::box_part({2, 2, 2 / kAspect}) : random_hull(random, {1, 1, 1 / kAspect});
}

Vec3 corner(const ConvexPart& part, int v) { return to_vec3(part.vertices[v]); }
Vec3 any_corner(Random& random, const ConvexPart& part) {
  return corner(part, pick(random, static_cast<int>(part.vertices.size())));
}
Vec3 on_any_edge(Random& random, const ConvexPart& part) {
  const auto& loop = part.faces[pick(random, static_cast<int>(part.faces.size()))].vertices;
  const int c = pick(random, static_cast<int>(loop.size()));
  const Vec3 from = corner(part, loop[c]), to = corner(part, loop[(c + 1) % loop.size()]);
  return from + uniform(random, 0, 1) * (to - from);
}
Vec3 on_face(Random& random, const ConvexPart& part, int face) {
  const auto& loop = part.faces[face].vertices;
  const double s = uniform(random, 0, 0.5), t = uniform(random, 0, 0.5);
  const Vec3 origin = corner(part, loop[0]);
  return origin + s * (corner(part, loop[1]) - origin) + t * (corner(part, loop[2]) - origin);
}
Vec3 on_any_face(Random& random, const ConvexPart& part) {
  return on_face(random, part, pick(random, static_cast<int>(part.faces.size())));
}

BodyPose anywhere(Random& random) { return {3 * random_direction(random), random_rotation(random)}; }

/// b's point x_b at a's point x_a (body frames).
void join(PosePair& poses, const Vec3& x_a, const Vec3& x_b) {
  poses.b.position =
      poses.a.position + rotate(poses.a.orientation, x_a) - poses.b.scale * rotate(poses.b.orientation, x_b);
}

/// Anywhere near one another: most pairs overlap.
Pair nearby(Random& random, ConvexPart a, ConvexPart b, double largest_distance = 0.9) {
  Pair pair{std::move(a), std::move(b), {anywhere(random), anywhere(random)}};
  pair.poses.b.position = pair.poses.a.position + uniform(random, 0, largest_distance) * random_direction(random);
  return pair;
}

Pair thin_pair(Random& random) {
  ConvexPart a = pick(random, 2) ? needle(random) : plate(random);
  switch (pick(random, 3)) {
    case 0:
      return nearby(random, std::move(a), needle(random), 0.2);
    case 1:
      return nearby(random, std::move(a), plate(random), 0.2);
    default:
      return nearby(random, std::move(a), random_body(random));
  }
}

/// A vertex of b below a face of a by a millionth to a tenth of the size, the rest of b above it.
Pair shallow(Random& random) {
  Pair pair = nearby(random, random_body(random), random_body(random));
  const int face = pick(random, static_cast<int>(pair.part_a.faces.size()));
  const Vec3 normal = to_vec3(pair.part_a.faces[face].plane.normal);
  const Vec3 down = -rotate_back(pair.poses.b.orientation, rotate(pair.poses.a.orientation, normal));
  const Vec3 lowest = to_vec3(
      *std::max_element(pair.part_b.vertices.begin(), pair.part_b.vertices.end(),
                        [&](const auto& p, const auto& q) { return dot(to_vec3(p), down) < dot(to_vec3(q), down); }));
  join(pair.poses, on_face(random, pair.part_a, face) - log_uniform(random, 1e-6, 0.1) * normal, lowest);
  return pair;
}

/// Boxes stacked with an angle of 1e-9 between their touching faces, and then anything sideways.
Pair nearly_parallel(Random& random) {
  Pair pair{random_box(random), random_box(random), {anywhere(random), {}}};
  pair.poses.b.orientation = pair.poses.a.orientation * axis_angle(random_direction(random), 1e-9);
  const Vec3 a = corner(pair.part_a, 7), b = corner(pair.part_b, 7);  // half the edges
  const double depth = pick(random, 2) ? log_uniform(random, 1e-10, 0.3) : 0;
  join(pair.poses, {uniform(random, -a.x, a.x), uniform(random, -a.y, a.y), a.z - depth}, {0, 0, -b.z});
  return pair;
}

Pair vertex_on_face(Random& random) {
  Pair pair = nearby(random, random_body(random), random_body(random));
  join(pair.poses, on_any_face(random, pair.part_a), any_corner(random, pair.part_b));
  return pair;
}

Pair edge_on_edge(Random& random) {
  const bool is_parallel = pick(random, 2);
  Pair pair = nearby(random, is_parallel ? random_box(random) : random_body(random),
                     is_parallel ? random_box(random) : random_body(random));
  if (is_parallel) pair.poses.b.orientation = pair.poses.a.orientation;
  join(pair.poses, on_any_edge(random, pair.part_a), on_any_edge(random, pair.part_b));
  return pair;
}

/// The same body twice; a box may also be turned onto itself.
Pair coincident(Random& random) {
  Pair pair{random_body(random), {}, {anywhere(random), {}}};
  pair.part_b = pair.part_a;
  pair.poses.b = pair.poses.a;
  if (pick(random, 3) == 0) {
    pair.part_a = pair.part_b = test_support::unit_cube();
    pair.poses.b.orientation = pair.poses.a.orientation * axis_angle({0, 0, 1}, std::numbers::pi / 2);
  }
  if (pick(random, 3) == 0) pair.poses.a.orientation = pair.poses.b.orientation = {};
  return pair;
}

/// b inside a, well within or in a corner of it.
Pair contained(Random& random) {
  Pair pair = nearby(random, random_box(random), random_body(random), 0.05);
  pair.poses.b.scale = uniform(random, 0.01, 0.1);
  if (pick(random, 2)) {
    pair.part_b = random_box(random);
    pair.poses.b.orientation = pair.poses.a.orientation;
    join(pair.poses, corner(pair.part_a, 7), corner(pair.part_b, 7));
  }
  return pair;
}

/// Boxes of one attitude: along each axis flush on one side, one on top of the other, or anyhow; flush to rounding or
/// with gaps and overlaps down to it.
Pair coplanar(Random& random) {
  Pair pair{random_box(random), random_box(random), {anywhere(random), {}}};
  if (pick(random, 3) == 0) pair.poses.a.orientation = {};
  pair.poses.b.orientation = pair.poses.a.orientation;
  const Vec3 a = corner(pair.part_a, 7), b = corner(pair.part_b, 7);
  const auto offset = [&](double half_a, double half_b) {
    const double sign = pick(random, 2) ? 1 : -1;
    switch (pick(random, 5)) {
      case 0:
        return sign * (half_a - half_b);
      case 1:
        return sign * (half_a + half_b);
      default:
        return uniform(random, -1, 1) * (half_a + half_b);
    }
  };
  join(pair.poses, {offset(a.x, b.x), offset(a.y, b.y), offset(a.z, b.z)}, {});
  return pair;
}

double noise(Random& random, double most) { return log_uniform(random, 1e-16, most); }

/// Boxes and plates of which some faces lie in one plane, on the same side or one on top of the other.
Pair flush_boxes(Random& random) {
  const auto box = [&] {
    Vec3 edges{uniform(random, 0.3, 1.5), uniform(random, 0.3, 1.5), uniform(random, 0.3, 1.5)};
    if (pick(random, 2)) edges.z *= log_uniform(random, 0.005, 1);
    return dem_gpu::box_part(edges);
  };
  const ConvexPart a = box();
  // Some are as large as one another along an axis or two, as a plate cut from a block.
  const Vec3 half = corner(a, 7), other = corner(box(), 7);
  const auto own_or = [&](double own, double another) { return pick(random, 2) ? own : another; };
  const Vec3 b{own_or(half.x, other.x), own_or(half.y, other.y), own_or(half.z, other.z)};
  Pair pair{a, dem_gpu::box_part(2 * b), {anywhere(random), {}}};
  if (pick(random, 3) == 0) pair.poses.a.orientation = {};
  pair.poses.b.orientation = pair.poses.a.orientation;
  const auto offset = [&](double half_a, double half_b) {
    const double sign = pick(random, 2) ? 1 : -1, shift = noise(random, 1e-9) * (pick(random, 3) - 1);
    switch (pick(random, 5)) {
      case 0:
      case 1:
        return sign * (half_a - half_b) + shift;
      case 2:
        return sign * (half_a + half_b) + shift;
      default:
        return uniform(random, -1, 1) * (half_a + half_b);
    }
  };
  join(pair.poses, {offset(half.x, b.x), offset(half.y, b.y), offset(half.z, b.z)}, {});
  return pair;
}

/// A body in the corner of a larger one of the same shape, or as large: the faces about that corner are flush.
Pair flush_at_a_corner(Random& random) {
  Pair pair{random_body(random), {}, {anywhere(random), {}}};
  pair.part_b = pair.part_a;
  pair.poses.b = pair.poses.a;
  if (pick(random, 3) != 0) pair.poses.b.scale = uniform(random, 0.1, 1);
  const Vec3 common = any_corner(random, pair.part_a);
  join(pair.poses, common, common);
  pair.poses.b.position += noise(random, 1e-9) * random_direction(random);
  return pair;
}

/// Faces in one plane but for noise: in tilt and offset from rounding to far above it, where what counts as flush must
/// not change the overlap.
Pair nearly_flush(Random& random) {
  Pair pair = pick(random, 3) ? flush_boxes(random) : flush_at_a_corner(random);
  pair.poses.b.orientation = pair.poses.b.orientation * axis_angle(random_direction(random), noise(random, 1e-6));
  if (pick(random, 2)) std::swap(pair.part_a, pair.part_b), std::swap(pair.poses.a, pair.poses.b);
  return pair;
}

Pair far_away(Random& random) {
  Pair pair = pick(random, 2) ? nearby(random, random_body(random), random_body(random)) : thin_pair(random);
  const Vec3 shift = 1e6 * random_direction(random);
  pair.poses.a.position += shift;
  pair.poses.b.position += shift;
  return pair;
}

/// Both tiny, both huge, or a grain against a boulder.
Pair scaled(Random& random) {
  Pair pair = nearby(random, random_body(random), random_body(random));
  if (pick(random, 2)) {
    const double scale = pick(random, 2) ? 1e-6 : 1e6;
    for (BodyPose* pose : {&pair.poses.a, &pair.poses.b}) pose->scale = scale, pose->position *= scale;
    return pair;
  }
  BodyPose& grain = pick(random, 2) ? pair.poses.a : pair.poses.b;
  grain.scale = log_uniform(random, 1e-3, 1);
  const double out = 1 + uniform(random, -0.5, 0.5) * grain.scale;  // of the boulder's surface
  if (grain.scale == pair.poses.b.scale)
    join(pair.poses, out * on_any_face(random, pair.part_a), {});
  else
    pair.poses.a.position =
        pair.poses.b.position + out * rotate(pair.poses.b.orientation, on_any_face(random, pair.part_b));
  return pair;
}

}  // namespace

const std::vector<PairClass>& pair_classes() {
  static const std::vector<PairClass> classes{
      {"cubes", 12, [](Random& r) { return nearby(r, test_support::unit_cube(), test_support::unit_cube()); }},
      {"tetrahedra", 8,
       [](Random& r) { return nearby(r, test_support::tetrahedron(1.5), test_support::tetrahedron(1.5)); }},
      {"hulls of 4 to 32 vertices", 16, [](Random& r) { return nearby(r, random_hull(r), random_hull(r)); }},
      {"needles and plates of aspect 50", 12, thin_pair},
      {"shallow, 1e-6 to 0.1 deep", 10, shallow},
      {"faces parallel to 1e-9", 6, nearly_parallel},
      {"vertex on a face", 6, vertex_on_face},
      {"edge on edge", 6, edge_on_edge},
      {"coincident", 4, coincident},
      {"contained", 4, contained},
      {"coplanar faces", 6, coplanar},
      {"a million sizes from the origin", 5, far_away},
      {"tiny, huge, grain on boulder", 5, scaled},
      {"flush but for noise", 12, nearly_flush},
  };
  return classes;
}

}  // namespace exact
