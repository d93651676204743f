// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem_gpu/snapshot.h"

namespace postprocess {

// VTK XML files (VTP) of one snapshot, appended raw encoding, compressed; equal snapshots give equal bytes. Each is
// written beside and renamed. All throw std::runtime_error naming the file if the disk does not take it, and
// catalog::InputError if the snapshot is not of the geometry's run.

/// Surfaces of the active bodies; cell data body_id, shape_id, material_id, speed [m/s], angular_speed [rad/s],
/// mass [kg]. Spheres become icospheres.
void write_bodies_vtp(const std::filesystem::path& file, const dem_gpu::RunGeometry& geometry,
                      const dem_gpu::Snapshot& snapshot);

/// Surfaces of the walls that are present; cell data wall_id, wall_kind (WallKind as a number). A plane becomes
/// the part of it within the scene.
void write_walls_vtp(const std::filesystem::path& file, const dem_gpu::RunGeometry& geometry,
                     const dem_gpu::Snapshot& snapshot);

/// Contacts: a vertex at each contact point, then a line through it that joins what touches (a body's centre, or the
/// point itself at a wall): force chains. Cell data force [N], force_magnitude [N], overlap [m], body_a, body_b.
void write_contacts_vtp(const std::filesystem::path& file, const dem_gpu::RunGeometry& geometry,
                        const dem_gpu::Snapshot& snapshot);

/// ParaView series: time and file name of each step, names relative to the PVD file.
struct SeriesEntry {
  double time = 0;  // [s]
  std::string file;
};
void write_pvd(const std::filesystem::path& file, const std::vector<SeriesEntry>& entries);

/// Writes text beside and renames. Throws std::runtime_error naming the file if the disk does not take it.
void write_text_file(const std::filesystem::path& file, const std::string& text);

}  // namespace postprocess
