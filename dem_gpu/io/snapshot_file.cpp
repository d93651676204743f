// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "dem_gpu/io/columns.h"
#include "dem_gpu/io/hdf5_file.h"
#include "dem_gpu/snapshot.h"

namespace dem_gpu {
namespace {

constexpr const char* kKind = "snapshot";
constexpr int kVersion = 1;

void write_contacts(io::Hdf5Writer& file, const std::vector<SnapshotContact>& contacts) {
  std::vector<std::int32_t> bodies;
  std::vector<Vec3> points, forces;
  std::vector<double> overlaps;
  for (const SnapshotContact& contact : contacts) {
    bodies.insert(bodies.end(), {contact.body_a, contact.body_b});
    points.push_back(contact.point);
    forces.push_back(contact.force);
    overlaps.push_back(contact.overlap);
  }
  file.write("contacts/bodies", bodies, 2);
  file.write("contacts/point", io::rows_of(points), 3);
  file.write("contacts/force", io::rows_of(forces), 3);
  file.write("contacts/overlap", overlaps);
}

std::vector<SnapshotContact> read_contacts(const io::Hdf5Reader& file, int body_count, int wall_count) {
  const std::vector<std::int32_t> bodies = file.read<std::int32_t>("contacts/bodies", 2);
  const std::size_t count = bodies.size() / 2;
  const std::vector<Vec3> points = io::vectors_of(file.read<double>("contacts/point", io::ArrayShape{count, 3}));
  const std::vector<Vec3> forces = io::vectors_of(file.read<double>("contacts/force", io::ArrayShape{count, 3}));
  const std::vector<double> overlaps = file.read<double>("contacts/overlap", io::ArrayShape{count, 1});
  std::vector<SnapshotContact> contacts(count);
  for (std::size_t c = 0; c < count; ++c) {
    contacts[c] = {bodies[2 * c], bodies[2 * c + 1], points[c], forces[c], overlaps[c]};
    const auto& [a, b, point, force, overlap] = contacts[c];
    if (a < 0 || a >= body_count || b >= body_count || b < -wall_count)
      file.refuse("dataset contacts/bodies row " + std::to_string(c),
                  "names a body or wall that the snapshot does not have");
  }
  return contacts;
}

}  // namespace

void write_snapshot(const std::filesystem::path& path, const Snapshot& snapshot) {
  io::Hdf5Writer file(path, kKind, kVersion);
  file.write_attribute("time", snapshot.time);
  file.write_attribute("step", snapshot.step);
  file.write("bodies/active", io::rows_of(snapshot.active));
  file.write("bodies/position", io::rows_of(snapshot.position), 3);
  file.write("bodies/orientation", io::rows_of(snapshot.orientation), 4);
  file.write("bodies/velocity", io::rows_of(snapshot.velocity), 3);
  file.write("bodies/angular_velocity", io::rows_of(snapshot.angular_velocity), 3);
  file.write("walls/translation", io::rows_of(snapshot.wall_translation), 3);
  file.write("walls/rotation", io::rows_of(snapshot.wall_rotation), 4);
  file.write("walls/present", io::rows_of(snapshot.wall_present));
  write_contacts(file, snapshot.contacts);
  file.commit();
}

Snapshot read_snapshot(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path, kKind, kVersion);
  Snapshot snapshot;
  snapshot.time = file.double_attribute("time");
  snapshot.step = file.integer_attribute("step");
  snapshot.active = io::flags_of(file.read<std::uint8_t>("bodies/active"));
  const std::size_t bodies = snapshot.active.size();
  snapshot.position = io::vectors_of(file.read<double>("bodies/position", io::ArrayShape{bodies, 3}));
  snapshot.orientation = io::quaternions_of(file.read<double>("bodies/orientation", io::ArrayShape{bodies, 4}));
  snapshot.velocity = io::vectors_of(file.read<double>("bodies/velocity", io::ArrayShape{bodies, 3}));
  snapshot.angular_velocity = io::vectors_of(file.read<double>("bodies/angular_velocity", io::ArrayShape{bodies, 3}));
  snapshot.wall_present = io::flags_of(file.read<std::uint8_t>("walls/present"));
  const std::size_t walls = snapshot.wall_present.size();
  snapshot.wall_translation = io::vectors_of(file.read<double>("walls/translation", io::ArrayShape{walls, 3}));
  snapshot.wall_rotation = io::quaternions_of(file.read<double>("walls/rotation", io::ArrayShape{walls, 4}));
  snapshot.contacts = read_contacts(file, static_cast<int>(bodies), static_cast<int>(walls));
  return snapshot;
}

double read_snapshot_time(const std::filesystem::path& path) {
  return io::Hdf5Reader(path, kKind, kVersion).double_attribute("time");
}

std::vector<std::filesystem::path> snapshot_files(const std::filesystem::path& run_folder) {
  const std::string prefix = "snapshot_";
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(run_folder / "snapshots", error)) {
    const std::string stem = entry.path().stem().string();
    const bool is_numbered = stem.size() > prefix.size() && stem.starts_with(prefix) &&
                             stem.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
    if (is_numbered && entry.path().extension() == ".h5") files.push_back(entry.path());
  }
  // By number: names grow longer past 999999.
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    const std::string x = a.filename().string(), y = b.filename().string();
    return x.size() != y.size() ? x.size() < y.size() : x < y;
  });
  return files;
}

}  // namespace dem_gpu
