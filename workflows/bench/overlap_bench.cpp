// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "workflows/bench/bench_registry.h"
#include "workflows/bench/bench_shapes.h"
#include "workflows/bench/cpu_clock.h"
#include "workflows/bench/plain_overlap.h"

namespace workflows {
namespace {

using dem_gpu::axis_angle;
using dem_gpu::BodyPose;
using dem_gpu::DepthPotential;
using dem_gpu::OverlapProbe;
using dem_gpu::OverlapVolume;
using dem_gpu::PosePair;
using dem_gpu::Quaternion;
using dem_gpu::Shape;
using dem_gpu::Vec3;

constexpr double kDegree = std::numbers::pi / 180;
/// Relative error allowed where the closed form is exact: a few hundred roundings of the overlap's own size, in mixed
/// precision of the bodies' size.
constexpr double kExact = dem_gpu::local_tolerance(1e-12, 1e-4);
/// After a motion by ten edges poses are rounded to 1e-15 of an edge, a share of 1e-12 of the thinnest overlap here.
constexpr double kExactAfterMotion = dem_gpu::local_tolerance(1e-10, 1e-4);
/// Of the engine's clipping over a plain scalar one in the same run: 4.5 when this was written.
constexpr double kLeastGain = 3;
constexpr int kMotions = 100;
/// Pairs placed farther off test just that, and are not moved about besides [edges].
constexpr double kFarAway = 1e3;

const Vec3 kUnit{1, 1, 1};
const Vec3 kDiagonal = kUnit / std::sqrt(3.0);

Quaternion turned(const Vec3& axis, double degrees) { return axis_angle(axis, degrees * kDegree); }

/// Turns the unit vector `from` into the unit vector `to`, not opposite to it.
Quaternion turn_between(const Vec3& from, const Vec3& to) {
  const Vec3 axis = cross(from, to);
  return axis_angle(axis / norm(axis), std::atan2(norm(axis), dot(from, to)));
}

/// Cube standing on a vertex: its corner (1,1,1)/2 points down.
Quaternion vertex_down() { return turn_between(kDiagonal, {0, 0, -1}); }

OverlapProbe volume_probe(const Shape& a, const Shape& b) { return OverlapProbe(a, b, OverlapVolume{1}); }

/// One pair with its exact overlap.
struct ExactOverlap {
  std::string name;
  Shape a, b;
  PosePair poses;
  double volume = 0;             // [m3]
  std::optional<Vec3> centroid;  // [m]
};

/// Error over the exact value, or over one unit cube where that is zero.
double relative_error(double value, double exact) {
  return std::abs(value - exact) / (exact != 0 ? std::abs(exact) : 1);
}

/// The pair after one rigid motion of both bodies.
PosePair moved(const PosePair& poses, const Quaternion& rotation, const Vec3& shift) {
  const auto move = [&](const BodyPose& pose) {
    return BodyPose{rotate(rotation, pose.position) + shift, rotation * pose.orientation, pose.scale};
  };
  return {move(poses.a), move(poses.b)};
}

/// Worst error of V over random rigid motions of the pair by up to ten edges.
double error_after_motions(const ExactOverlap& pair) {
  const OverlapProbe probe = volume_probe(pair.a, pair.b);
  std::mt19937_64 random(12);
  double worst = 0;
  for (int i = 0; i < kMotions; ++i) {
    const Vec3 shift = uniform(random, 0, 10) * random_direction(random);
    const double volume = probe.overlap(moved(pair.poses, random_rotation(random), shift)).volume;
    worst = std::max(worst, relative_error(volume, pair.volume));
  }
  return worst;
}

/// No overlap, or one that is its own mirror image about the bodies' common centre: the contact force is zero.
bool has_no_force(const ExactOverlap& pair) {
  return pair.volume == 0 || pair.poses.a.position == pair.poses.b.position;
}

CaseResult measure_exact(const std::vector<ExactOverlap>& pairs) {
  double volume_error = 0, centroid_error = 0, area_error = 0, stray_force = 0;
  std::optional<double> motion_error;
  bool has_centroid = false, has_balanced = false;
  for (const ExactOverlap& pair : pairs) {
    const auto found = volume_probe(pair.a, pair.b).overlap(pair.poses);
    const auto swapped = volume_probe(pair.b, pair.a).overlap({pair.poses.b, pair.poses.a});
    for (const double volume : {found.volume, swapped.volume})
      volume_error = std::max(volume_error, relative_error(volume, pair.volume));
    area_error = std::max(area_error, norm(found.area + swapped.area));
    if (norm(pair.poses.a.position) < kFarAway)
      motion_error = std::max(motion_error.value_or(0), error_after_motions(pair));
    if (has_no_force(pair)) {
      has_balanced = true;
      stray_force =
          std::max(stray_force, norm(OverlapProbe(pair.a, pair.b, DepthPotential{1}).contact(pair.poses).force));
    }
    if (!pair.centroid) continue;
    has_centroid = true;
    centroid_error = std::max(centroid_error, norm(found.centroid - *pair.centroid));
  }
  CaseResult result;
  const auto add = [&](const std::string& name, double value, const std::string& unit, double bound) {
    result.figures.push_back({name, value, unit, at_most(bound), ""});
  };
  add("V, error", volume_error, "-", kExact);
  if (motion_error) add("V, error after rigid motions", *motion_error, "-", kExactAfterMotion);
  if (has_centroid) add("centroid, error", centroid_error, "edge", kExact);
  add("S of a in b plus S of b in a", area_error, "edge2", kExact);
  if (has_balanced) add("depth potential, force that must vanish", stray_force, "k edge3", kExact);
  return result;
}

/// O1, its centroid too where the origin is near enough for it to be exact.
ExactOverlap shifted_cubes(const std::string& name, const Vec3& origin) {
  const Shape cube = box_shape(kUnit);
  const Vec3 b = origin + Vec3{0.9, 0.3, 0.2};
  const Vec3 shift = b - origin;  // as rounded far from the origin
  ExactOverlap pair{name, cube, cube, {{origin}, {b}}, (1 - shift.x) * (1 - shift.y) * (1 - shift.z), {}};
  if (norm(origin) == 0) pair.centroid = origin + 0.5 * shift;
  return pair;
}

std::vector<ExactOverlap> half_space_cases() {
  // The half-space x + y + z <= t against [0,1]^3 is a block 8 wide, its top face turned to (1,1,1).
  std::vector<ExactOverlap> pairs;
  const Shape cube = box_shape(kUnit), block = box_shape({8, 8, 8});
  for (const double t : {0.05, 0.5, 1.0, 1.5}) {
    const Vec3 centre = (t / std::sqrt(3.0) - 4) * kDiagonal;
    const double volume = t <= 1 ? t * t * t / 6 : 0.5;
    pairs.push_back({"O6", cube, block, {{0.5 * kUnit}, {centre, turn_between({0, 0, 1}, kDiagonal)}}, volume, {}});
  }
  return pairs;
}

std::vector<ExactOverlap> coincidence_cases() {
  const Shape cube = box_shape(kUnit), small = box_shape({0.3, 0.4, 0.5});
  const double edge = std::sqrt(0.5);  // from the centre to an edge
  const Quaternion edge_down = turned({1, 0, 0}, 45);
  return {{"coincident", cube, cube, {{}, {}}, 1, Vec3{}},
          {"inside", cube, small, {{}, {{0.1, 0.05, -0.1}}}, 0.06, Vec3{0.1, 0.05, -0.1}},
          {"faces touching", cube, cube, {{}, {{0, 0, 1}}}, 0, {}},
          {"faces touching, offset", cube, cube, {{}, {{0.25, 0.5, 1}}}, 0, {}},
          {"edge on edge", cube, cube, {{}, {{1, 1, 0}}}, 0, {}},
          {"edge on face", cube, cube, {{}, {{0, 0, 0.5 + edge}, edge_down}}, 0, {}},
          {"vertex on face", cube, cube, {{}, {{0, 0, 0.5 + std::sqrt(0.75)}, vertex_down()}}, 0, {}}};
}

/// Unit cubes stacked `height` apart, the upper one tilted about x: in the yz plane the overlap is a quadrilateral
/// between the upper cube's lower left corner, its lower face, the lower cube's right side and its top.
double tilted_stack_volume(double height, double tilt) {
  const double slope = std::tan(tilt);
  // Relative to the lower cube's upper right edge.
  const double corner_y = 0.5 * std::sin(tilt) - 0.5 * std::cos(tilt) - 0.5;
  const double corner_z = height - 0.5 * std::cos(tilt) - 0.5 * std::sin(tilt) - 0.5;
  const double right_z = corner_z - corner_y * slope;
  const double top_y = corner_y + corner_z * slope;
  return 0.5 * (corner_y * right_z + top_y * corner_z);
}

/// Name of a case and the pairs it holds: benchmark pairs O1 .. O12.
std::vector<std::pair<std::string, std::vector<ExactOverlap>>> exact_overlaps() {
  const Shape cube = box_shape(kUnit), tetrahedron = tetrahedron_shape();
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, centre{};
  const double crossing = std::sqrt(2.0) - 1.4, depth = 0.05;
  const double vertex_height = 0.5 + std::sqrt(0.75) - depth;
  return {
      {"O1", {shifted_cubes("O1", {})}},
      {"O2", {{"O2", cube, cube, {{}, {centre, turned(z, 45)}}, 2 * (std::sqrt(2.0) - 1), centre}}},
      {"O3", {{"O3", cube, cube, {{}, {centre, turned(kDiagonal, 60)}}, 0.75, centre}}},
      {"O4", {{"O4", tetrahedron, tetrahedron, {{}, {centre, turned(z, 90)}}, 1.0 / 6, centre}}},
      {"O5", {{"O5", box_shape({1, 1, 1}), octahedron_shape(), {{}, {}}, 5.0 / 6, centre}}},
      {"O6", half_space_cases()},
      {"O7",
       {{"O7",
         cube,
         cube,
         {{centre, turned(x, 45)}, {{0, 0, 1.4}, turned(y, 45)}},
         2.0 / 3 * std::pow(crossing, 3),
         Vec3{0, 0, 0.7}}}},
      {"O8",
       {{"O8",
         cube,
         cube,
         {{}, {{0, 0, vertex_height}, vertex_down()}},
         std::sqrt(0.75) * std::pow(depth, 3),
         Vec3{0, 0, 0.5 - depth / 4}}}},
      {"O9", {{"O9", cube, cube, {{}, {{0, 0, 0.999}, axis_angle(x, 1e-6)}}, tilted_stack_volume(0.999, 1e-6), {}}}},
      {"O10",
       {{"O10",
         cube,
         box_shape({2, 1e-3, 1e-3}),
         {{}, {centre, turned(z, 30)}},
         1e-6 / std::cos(30 * kDegree),
         centre}}},
      {"O11", {shifted_cubes("O11", 1e6 * kUnit)}},
      {"O12", coincidence_cases()}};
}

/// Depth potential of stiffness 1 against closed forms. The field of a body is the least depth below its faces, so
/// force = integral over the overlap of grad(depth_a) - grad(depth_b); for a flat top that part is V.
CaseResult measure_depth_forms() {
  const DepthPotential law{1};
  const Shape cube = box_shape(kUnit), slab = box_shape({4, 4, 1});
  const double edge = std::sqrt(0.5);
  CaseResult result;
  const auto compare = [&](const std::string& name, const Shape& a, const Shape& b, const PosePair& poses,
                           double exact) {
    const OverlapProbe probe(a, b, law);
    const auto error = [&](const PosePair& pair, const Quaternion& rotation) {
      return norm(probe.contact(pair).force - rotate(rotation, Vec3{0, 0, -exact})) / exact;
    };
    std::mt19937_64 random(12);
    double worst = 0;
    for (int i = 0; i < kMotions; ++i) {
      const Quaternion rotation = random_rotation(random);
      worst =
          std::max(worst, error(moved(poses, rotation, uniform(random, 0, 10) * random_direction(random)), rotation));
    }
    result.figures.push_back({name + ", force error", error(poses, {}), "-", at_most(kExact), ""});
    result.figures.push_back({name + ", force error after rigid motions", worst, "-", at_most(kExactAfterMotion), ""});
  };
  // Aligned faces: both fields are min(d, distance to the sides); their integral over the square is that of a frustum.
  double d = 0.01;
  compare("face on face", cube, cube, {{}, {{0, 0, 1 - d}}}, 2 * (d - 2 * d * d + 4 * d * d * d / 3));
  // Edge: V = d^2 below the slab's top; the cube's own field is a hipped roof over the strip 1 x 2d, height d/sqrt2.
  d = 0.02;
  const double t = d / std::sqrt(2.0);
  const double roof = 2 * d * t - (2 * std::sqrt(2.0) + 4 * d) * t * t / 2 + 4 * std::sqrt(2.0) * t * t * t / 3;
  compare("edge on face", slab, cube, {{}, {{0, 0, 0.5 + edge - d}, turned({1, 0, 0}, 45)}}, d * d + roof);
  // Vertex: V = sqrt3/2 d^3, and the pyramid of the cube's own field over the triangle is d^3/2.
  d = 0.05;
  compare("vertex on face", cube, cube, {{}, {{0, 0, 0.5 + std::sqrt(0.75) - d}, vertex_down()}},
          (std::sqrt(0.75) + 0.5) * d * d * d);
  // Crossed edges (O7): both fields have slopes at 45 degrees, and V = 2/3 d^3.
  d = std::sqrt(2.0) - 1.4;
  compare("edge across edge", cube, cube, {{{}, turned({1, 0, 0}, 45)}, {{0, 0, 1.4}, turned({0, 1, 0}, 45)}},
          std::sqrt(2.0) * 2.0 / 3 * d * d * d);
  return result;
}

// Timing.

constexpr int kPairs = 4096;
constexpr int kWindows = 21;
constexpr double kWindowTime = 0.02;  // [s], long against the clock's resolution

enum class Placement { shallow, deep, separated };

/// Unit cubes at random attitudes and directions. Shallow: sunk in by up to 1 % of the edge along the line of centres;
/// deep: by up to half; separated: bounding spheres overlap, the cubes are up to 5 % of the edge apart.
std::vector<PosePair> random_pairs(const OverlapProbe& probe, Placement placement) {
  std::mt19937_64 random(20240217);
  std::vector<PosePair> pairs;
  const double bounding_contact = std::sqrt(3.0);
  while (pairs.size() < kPairs) {
    PosePair pair{{{}, random_rotation(random)}, {{}, random_rotation(random)}};
    const Vec3 direction = random_direction(random);
    const double touch = touch_distance(probe, pair, direction, bounding_contact);
    const double distance = placement == Placement::shallow ? touch - uniform(random, 1e-4, 0.01)
                            : placement == Placement::deep  ? touch - uniform(random, 0.01, 0.5)
                                                            : touch + uniform(random, 1e-4, 0.05);
    if (distance >= bounding_contact) continue;
    pair.b.position = distance * direction;
    pairs.push_back(pair);
  }
  return pairs;
}

/// Nanoseconds a pair: median, least and largest of the windows, in the thread's own time.
struct PairTime {
  double median, least, largest;
};

PairTime time_per_pair(const OverlapProbe& probe, const std::vector<PosePair>& pairs) {
  dem_gpu::SeparationCache cache;
  probe.count_contacts(pairs, cache);  // fills the cache
  std::vector<double> windows;
  for (int window = 0; window < kWindows; ++window) {
    const CpuClock clock;
    int sweeps = 0;
    do {
      probe.count_contacts(pairs, cache);
      ++sweeps;
    } while (clock.seconds() < kWindowTime);
    windows.push_back(1e9 * clock.seconds() / (static_cast<double>(sweeps) * static_cast<double>(pairs.size())));
  }
  std::sort(windows.begin(), windows.end());
  return {windows[kWindows / 2], windows.front(), windows.back()};
}

/// The same for any way to go once through all pairs.
template <class Sweep>
double median_time_per_pair(std::size_t pairs, const Sweep& sweep) {
  std::vector<double> windows;
  for (int window = 0; window < kWindows; ++window) {
    const CpuClock clock;
    sweep();
    windows.push_back(1e9 * clock.seconds() / static_cast<double>(pairs));
  }
  std::sort(windows.begin(), windows.end());
  return windows[kWindows / 2];
}

/// The engine against a plain scalar version on the same pairs in the same run.
CaseResult measure_against_plain(const std::vector<PosePair>& pairs) {
  const Shape cube = box_shape(kUnit);
  const PlainOverlap plain(cube, cube);
  const OverlapProbe probe = volume_probe(cube, cube);
  double difference = 0, volume = 0;
  for (const PosePair& pair : pairs)
    difference = std::max(difference, std::abs(plain.sums(pair).volume - probe.overlap(pair).volume));
  const double plain_time = median_time_per_pair(pairs.size(), [&] {
    for (const PosePair& pair : pairs) volume += plain.sums(pair).volume;
  });
  const double engine = time_per_pair(probe, pairs).median;
  const double depth = time_per_pair(OverlapProbe(cube, cube, DepthPotential{1}), pairs).median;
  CaseResult result;
  const auto add = [&](const std::string& name, double value, const std::string& unit, std::optional<Goal> goal) {
    result.figures.push_back({name, value, unit, goal, ""});
  };
  add("V, difference of the two", difference, "edge3", at_most(dem_gpu::local_tolerance(1e-14, 2e-7)));
  add("V, S, M, plain scalar version", volume > 0 ? plain_time : kFailedRun, "ns/pair", {});
  add("V, S, centroid, plain over engine", plain_time / engine, "-", at_least(kLeastGain));
  add("plain V, S, M over the engine's depth potential", plain_time / depth, "-", {});
  return result;
}

CaseResult time_laws(const std::vector<PosePair>& pairs, std::optional<Goal> volume_goal,
                     std::optional<Goal> depth_goal) {
  const Shape cube = box_shape(kUnit);
  CaseResult result;
  const auto report = [&](const std::string& law, const OverlapProbe& probe, std::optional<Goal> goal) {
    const PairTime time = time_per_pair(probe, pairs);
    result.figures.push_back({law + ", median", time.median, "ns/pair", goal, ""});
    result.figures.push_back({law + ", fastest window", time.least, "ns/pair", {}, ""});
    result.figures.push_back({law + ", slowest window", time.largest, "ns/pair", {}, ""});
  };
  report("V, S, centroid", volume_probe(cube, cube), volume_goal);
  report("depth potential", OverlapProbe(cube, cube, DepthPotential{1}), depth_goal);
  return result;
}

std::vector<PosePair> random_cube_pairs(Placement placement) {
  const Shape cube = box_shape(kUnit);
  return random_pairs(volume_probe(cube, cube), placement);
}

/// Separated pairs that a face plane of one cube tells apart, or those that only a plane through two edges would.
CaseResult measure_separated(bool by_face) {
  const Shape cube = box_shape(kUnit);
  std::vector<PosePair> chosen;
  const std::vector<PosePair> pairs = random_cube_pairs(Placement::separated);
  dem_gpu::SeparationCache cache;
  volume_probe(cube, cube).count_contacts(pairs, cache);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if ((cache[i] != 0) == by_face) chosen.push_back(pairs[i]);
  const std::optional<Goal> goal = by_face ? std::optional<Goal>(at_most(30)) : std::nullopt;
  CaseResult result = time_laws(chosen, goal, goal);
  result.figures.push_back({"share of the separated pairs", static_cast<double>(chosen.size()) / kPairs, "-", {}, ""});
  return result;
}

}  // namespace

BenchPlan plan_overlap_bench(const BenchOptions&) {
  BenchPlan plan;
  for (auto& [name, pairs] : exact_overlaps())
    plan.cases.push_back({name, [pairs = pairs] { return measure_exact(pairs); }});
  plan.cases.push_back({"depth-forms", measure_depth_forms});
  // Goals for contacts as a run has them; deep ones are shown beside.
  plan.cases.push_back(
      {"cost-touching", [] { return time_laws(random_cube_pairs(Placement::shallow), at_most(500), at_most(1000)); }});
  plan.cases.push_back(
      {"cost-against-plain", [] { return measure_against_plain(random_cube_pairs(Placement::shallow)); }});
  plan.cases.push_back({"cost-deep", [] { return time_laws(random_cube_pairs(Placement::deep), {}, {}); }});
  plan.cases.push_back({"cost-separated", [] { return measure_separated(true); }});
  plan.cases.push_back({"cost-separated-by-edges", [] { return measure_separated(false); }});
  return plan;
}

}  // namespace workflows
