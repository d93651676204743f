// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/postprocess/synthetic_run.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <string>

namespace test_support {

using catalog::ConvexPart;
using dem_gpu::Quaternion;
using dem_gpu::RunGeometry;
using dem_gpu::Snapshot;
using dem_gpu::Vec3;
using dem_gpu::WallKind;

namespace {

constexpr double kPi = std::numbers::pi;

/// Box with edges `size`, turned about z and moved.
ConvexPart box(const Vec3& size, const Vec3& centre, double turn = 0) {
  ConvexPart part;
  const Quaternion rotation = dem_gpu::axis_angle({0, 1, 0}, turn);
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner{(i & 1 ? 0.5 : -0.5) * size.x, (i & 2 ? 0.5 : -0.5) * size.y, (i & 4 ? 0.5 : -0.5) * size.z};
    const Vec3 v = rotate(rotation, corner) + centre;
    part.vertices.push_back({v.x, v.y, v.z});
  }
  const std::vector<std::vector<int>> loops{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& loop : loops) part.faces.push_back({loop, {{0, 0, 0}, 0}, catalog::FaceKind::outer});
  return part;
}

/// Double pyramid over a polygon of `corners` corners: 2 * corners triangles, corners + 2 vertices.
ConvexPart double_pyramid(int corners, const Vec3& half_size, const Vec3& centre) {
  ConvexPart part;
  for (int c = 0; c < corners; ++c)
    part.vertices.push_back({centre.x + half_size.x * std::cos(2 * kPi * c / corners),
                             centre.y + half_size.y * std::sin(2 * kPi * c / corners), centre.z});
  part.vertices.push_back({centre.x, centre.y, centre.z - half_size.z});
  part.vertices.push_back({centre.x, centre.y, centre.z + half_size.z});
  for (int c = 0; c < corners; ++c) {
    const int next = (c + 1) % corners;
    part.faces.push_back({{c, next, corners + 1}, {}, catalog::FaceKind::outer});
    part.faces.push_back({{next, c, corners}, {}, catalog::FaceKind::outer});
  }
  return part;
}

std::vector<dem_gpu::ShapeGeometry> grains(double size) {
  return {{"lump",
           0,
           {double_pyramid(7, {size, 0.8 * size, 0.7 * size}, {}),
            box({size, 0.9 * size, 0.8 * size}, {0.4 * size, 0, 0.1 * size}, 0.4)},
           3 * size * size * size},
          {"slab",
           0,
           {box({1.7 * size, 1.3 * size, 0.8 * size}, {}),
            double_pyramid(5, {0.6 * size, 0.6 * size, 0.9 * size}, {0.2 * size, 0.1 * size, 0})},
           2.2 * size * size * size}};
}

void add_body(RunGeometry& geometry, int shape, int material, double scale, double mass) {
  geometry.body_shape.push_back(shape);
  geometry.body_material.push_back(material);
  geometry.body_scale.push_back(scale);
  geometry.body_mass.push_back(mass);
}

/// Random turns and small speeds; the caller sets positions.
Snapshot resting(const RunGeometry& geometry, double time) {
  Snapshot snapshot;
  snapshot.time = time;
  snapshot.step = std::llround(time * 1e5);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (std::size_t b = 0; b < geometry.body_shape.size(); ++b) {
    snapshot.active.push_back(1);
    snapshot.position.push_back({});
    snapshot.orientation.push_back(
        dem_gpu::normalized({uniform(random), uniform(random), uniform(random), uniform(random)}));
    snapshot.velocity.push_back({});
    snapshot.angular_velocity.push_back({0, uniform(random), 0});
  }
  snapshot.wall_translation.assign(geometry.walls.size(), {});
  snapshot.wall_rotation.assign(geometry.walls.size(), {});
  snapshot.wall_present.assign(geometry.walls.size(), 1);
  return snapshot;
}

/// Contacts between neighbours in the list, and of every tenth body with wall 0.
void add_contacts(Snapshot& snapshot) {
  for (int b = 0; b + 1 < static_cast<int>(snapshot.position.size()); b += 2) {
    if (!snapshot.active[b] || !snapshot.active[b + 1]) continue;
    const Vec3 middle = 0.5 * (snapshot.position[b] + snapshot.position[b + 1]);
    snapshot.contacts.push_back({b, b + 1, middle, {0, 0, 1.0 + b}, 1e-5 * (1 + b % 10)});
    if (b % 10 == 0) snapshot.contacts.push_back({b, -1, snapshot.position[b], {3, 0, 4}, 2e-5});
  }
}

void write_text(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

std::string row(const std::vector<double>& values) {
  std::string line;
  for (const double value : values) {
    char text[40];
    std::snprintf(text, sizeof text, "%.12g", value);
    if (!line.empty()) line += ',';
    line += text;
  }
  return line + "\n";
}

const std::string kSeriesHeader =
    "time[s],step[-],active_bodies[-],active_mass[kg],removed_bodies[-],removed_mass[kg],contacts[-],kinetic[J],"
    "gravitational[J],elastic_normal[J],elastic_tangential[J],dissipated_normal[J],dissipated_shear[J],wall_work[J],"
    "removed_energy[J],imbalance[J],throughput[J],largest_overlap[-],steps_per_second[1/s]\n";
const std::string kWallsHeader =
    "time[s],wall,force_x[N],force_y[N],force_z[N],torque_x[N m],torque_y[N m],torque_z[N m],power[W],work[J]\n";
const std::string kLedgerHeader = "time[s],class,dissipation_normal[J],dissipation_shear[J]\n";

}  // namespace

RunGeometry mill_geometry() {
  RunGeometry geometry;
  geometry.shapes = grains(0.016);
  geometry.shapes.push_back({"ball", 0.022, {}, 4 * kPi / 3 * std::pow(0.022, 3)});
  geometry.materials = {"ore", "steel"};
  geometry.material_density = {2700, 7850};
  for (int b = 0; b < 380; ++b) {
    const bool is_ball = b % 8 == 0;
    add_body(geometry, is_ball ? 2 : b % 2, is_ball, is_ball ? 1.0 : 0.7 + 0.1 * (b % 5), is_ball ? 0.35 : 0.03);
  }
  dem_gpu::WallGeometry shell{"shell", "shell", WallKind::cylinder, {0, -0.15, 0}, {0, 1, 0}, 0.3, 0.3, 0, {}};
  dem_gpu::WallGeometry front{"front end", "end", WallKind::disc, {0, -0.15, 0}, {0, 1, 0}, 0, 0.3, 0, {}};
  dem_gpu::WallGeometry back{"back end", "end", WallKind::plane, {0, 0.15, 0}, {0, -1, 0}, 0, 0, 0, {}};
  geometry.walls = {shell, front, back};
  for (int l = 0; l < 8; ++l) {
    const double angle = 2 * kPi * l / 8;
    dem_gpu::WallGeometry lifter;
    lifter.name = "lifter " + std::to_string(l + 1);
    lifter.contact_class = "lifter";
    lifter.kind = WallKind::volume_object;
    lifter.part = box({0.035, 0.3, 0.03}, {0.285 * std::cos(angle), 0, 0.285 * std::sin(angle)}, -angle);
    geometry.walls.push_back(lifter);
  }
  return geometry;
}

Snapshot mill_snapshot(const RunGeometry& geometry, double time) {
  Snapshot snapshot = resting(geometry, time);
  const double angle = MillTruth{}.angular_speed * time;
  for (auto& rotation : snapshot.wall_rotation) rotation = dem_gpu::axis_angle({0, 1, 0}, angle);
  // The charge: a leaning segment of the drum, filled on a jittered lattice, faster towards its surface.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-0.006, 0.006);
  const double lean = time > 0 ? 0.6 : 0.0;
  std::size_t b = 0;
  for (double z = -0.265; z < 0.2 && b < geometry.body_shape.size(); z += 0.030)
    for (double x = -0.27; x < 0.27 && b < geometry.body_shape.size(); x += 0.034)
      for (double y = -0.125; y < 0.13 && b < geometry.body_shape.size(); y += 0.036) {
        if (x * x + z * z > 0.255 * 0.255) continue;
        const Vec3 place{x + jitter(random), y + jitter(random), z + jitter(random)};
        snapshot.position[b] = rotate(dem_gpu::axis_angle({0, 1, 0}, lean), place);
        const double speed = time > 0 ? 0.2 + 3 * std::max(0.0, z + 0.22) * (1 + std::abs(x)) : 0;
        snapshot.velocity[b] = {speed, 0, -0.2 * speed};
        ++b;
      }
  add_contacts(snapshot);
  return snapshot;
}

RunGeometry hopper_geometry() {
  RunGeometry geometry;
  geometry.shapes = grains(0.017);
  geometry.materials = {"ore", "steel"};
  geometry.material_density = {2700, 7850};
  for (int b = 0; b < 420; ++b) add_body(geometry, b % 2, 0, 0.8 + 0.1 * (b % 5), HopperTruth{}.body_mass);
  geometry.walls = {{"bin", "bin", WallKind::cylinder, {0, 0, 0.3}, {0, 0, 1}, 0.4, 0.2, 0, {}},
                    {"cone", "cone", WallKind::cone, {0, 0, 0.1}, {0, 0, 1}, 0.2, 0.075, 0.2, {}},
                    {"gate", "gate", WallKind::disc, {0, 0, 0.1}, {0, 0, 1}, 0, 0.075, 0, {}}};
  return geometry;
}

Snapshot hopper_snapshot(const RunGeometry& geometry, double time) {
  const HopperTruth truth;
  Snapshot snapshot = resting(geometry, time);
  const bool is_open = time >= truth.opening_time;
  snapshot.wall_present[2] = !is_open;
  const int removed = is_open ? static_cast<int>(truth.rate * (time - truth.opening_time) / truth.body_mass) : 0;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> jitter(-0.006, 0.006);
  std::size_t b = 0;
  for (int i = 0; i < removed && b < geometry.body_shape.size(); ++i) snapshot.active[b++] = 0;
  for (double z = is_open ? -0.05 : 0.13; b < geometry.body_shape.size(); z += 0.032) {
    const double radius = z < 0.1 ? 0.05 : z > 0.3 ? 0.18 : 0.055 + 0.125 * (z - 0.1) / 0.2;
    for (double x = -radius; x <= radius; x += 0.037)
      for (double y = -radius; y <= radius && b < geometry.body_shape.size(); y += 0.037) {
        if (x * x + y * y > radius * radius) continue;
        snapshot.position[b] = {x + jitter(random), y + jitter(random), z + jitter(random)};
        snapshot.velocity[b] = {0, 0, is_open ? -0.9 * std::exp(-(z + 0.05) / 0.12) : 0};
        ++b;
      }
  }
  add_contacts(snapshot);
  return snapshot;
}

MillTruth write_mill_run(const std::filesystem::path& folder) {
  const MillTruth truth;
  const RunGeometry geometry = mill_geometry();
  std::filesystem::create_directories(folder / "snapshots");
  dem_gpu::write_geometry(folder / "geometry.h5", geometry);
  for (int s = 0; s <= 4; ++s)
    dem_gpu::write_snapshot(folder / "snapshots" / ("snapshot_00000" + std::to_string(s) + ".h5"),
                            mill_snapshot(geometry, 1.5 * s));
  std::string series = kSeriesHeader, walls = kWallsHeader, ledger = kLedgerHeader;
  const int rows = 600;
  const double end = 6, step = end / rows;
  double work = 0;
  for (int r = 0; r <= rows; ++r) {
    const double t = r * step;
    // A ripple of eight lifter passes a revolution that averages out over each.
    const double torque = truth.torque * (1 + 0.3 * std::sin(8 * truth.angular_speed * (t - step / 2)));
    const double power = -torque * truth.angular_speed;
    if (r > 0) work += power * step;
    const double kinetic = 3, gravitational = 5, dissipated = std::max(0.0, work - kinetic - gravitational);
    series += row({t, std::round(t * 1e5), 380, 25, 0, 0, 700, r ? kinetic : 0, r ? gravitational : 0, 0, 0,
                   0.6 * dissipated, 0.4 * dissipated, work, 0, 0.004 * work, work, 0.013, 5000});
    // Half of the torque on the shell, half on the lifters.
    for (const char* wall : {"shell", "\"lifter 1\""})
      walls += row({t}).substr(0, row({t}).size() - 1) + "," + wall + "," +
               row({1, 0, -120, 0.1, torque / 2, -0.2, power / 2, work / 2});
    for (const auto& [name, share] :
         {std::pair{"particle-particle", 0.5}, {"particle-shell", 0.3}, {"particle-lifter", 0.2}})
      ledger += row({t}).substr(0, row({t}).size() - 1) + "," + name + "," +
                row({0.6 * share * dissipated, 0.4 * share * dissipated});
  }
  write_text(folder / "time_series.csv", series);
  write_text(folder / "walls.csv", walls);
  write_text(folder / "ledger.csv", ledger);
  write_text(folder / "resolved_scene.json", R"({"name": "mill", "gravity": [0, 0, -9.81]})");
  write_text(folder / "run.json",
             R"({"name": "Test mill <8 lifters>", "finished": true, "simulated_time": 6.0, "steps": 600000,
 "time_step": 1e-5, "wall_seconds": 120.5, "backend": "TBB", "precision": "double",
 "energy": {"kinetic": 3, "gravitational": 5, "imbalance": 2.4, "throughput": 600, "imbalance_share": 0.004},
 "dissipation": [{"class": "particle-particle", "normal": 180, "shear": 120}, {"class": "particle-shell", "normal": 100, "shear": 80}],
 "quality": {"largest_overlap": 0.013, "smallest_steps_per_contact": 18.4},
 "mill": {"axis": [0, 1, 0], "revolutions": 2.39, "power_torque_mean": 100.2, "power_torque_ci": 3.1, "power_ledger_mean": 99.8, "from_time": 3.5, "to_time": 6.0},
 "size_distribution": {"definition": "volume-equivalent", "basis": "mass", "requested": [[0.02, 0], [0.03, 0.5], [0.04, 1]],
   "realised": [[0.02, 0], [0.03, 0.47], [0.04, 1]], "d10": 0.022, "d50": 0.0302, "d80": 0.036, "d90": 0.038},
 "shapes": [{"name": "lump", "parts": 2, "vertices": 17, "faces": 20, "volume": 1.2e-5, "symmetric_difference": 0.031, "volume_error": 0.0}],
 "passes": ["broad_phase", "narrow_phase", "contact_force", "integrate"],
 "command": "talus simulate mill.toml --out runs/mill", "tool_version": "talus 0.1.0", "warnings": ["3 bodies were placed twice"]})");
  return truth;
}

HopperTruth write_hopper_run(const std::filesystem::path& folder) {
  const HopperTruth truth;
  const RunGeometry geometry = hopper_geometry();
  std::filesystem::create_directories(folder / "snapshots");
  dem_gpu::write_geometry(folder / "geometry.h5", geometry);
  for (int s = 0; s <= 4; ++s)
    dem_gpu::write_snapshot(folder / "snapshots" / ("snapshot_00000" + std::to_string(s) + ".h5"),
                            hopper_snapshot(geometry, 0.5 * s));
  std::string series = kSeriesHeader;
  const double bodies = static_cast<double>(geometry.body_shape.size());
  for (int r = 0; r <= 200; ++r) {
    const double t = 0.05 * r;
    const double mass = std::min(bodies * truth.body_mass, truth.rate * std::max(0.0, t - truth.opening_time));
    const double count = std::floor(mass / truth.body_mass + 1e-9);
    series +=
        row({t, std::round(t * 2e4), bodies - count, bodies * truth.body_mass - mass, count, mass, 800, 0.2 + mass / 10,
             -3 * mass, 0.01, 0.002, 1.2 * mass, 0.9 * mass, 0, 0.5 * mass, 0.01 * mass, 3 * mass, 0.02, 9000});
  }
  write_text(folder / "time_series.csv", series);
  write_text(folder / "resolved_scene.json", R"({"name": "hopper", "gravity": [0, 0, -9.81]})");
  return truth;
}

}  // namespace test_support
