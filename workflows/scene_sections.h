// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "workflows/scene_reader.h"
#include "workflows/toml_table.h"

namespace workflows {

// The sections of a scene file, one source file for each group; scene_reader.cpp calls them in order.

inline dem_gpu::Vec3 to_vec3(const Point& p) { return {p[0], p[1], p[2]}; }
inline Point to_point(const dem_gpu::Vec3& v) { return {v.x, v.y, v.z}; }

/// Components of velocities: beyond it squares of speeds and the step of a run lose their meaning.
inline constexpr Bounds kSpeed{-1e6, 1e6, false, "from -1e6 to 1e6 m/s"};

/// Index of the material named at `key`.
int read_material_name(TomlTable& table, std::string_view key, const std::vector<dem_gpu::Material>& materials);

/// [motion.NAME] tables, for the walls of a group to share.
using NamedMotions = std::map<std::string, dem_gpu::Motion>;
NamedMotions read_motions(TomlTable& file, SceneDescription& description);

/// [[wall]] and [[lifters]], in this order. Refuses equal names. Mesh files are sought from `base_folder`.
void read_walls(TomlTable& file, const NamedMotions& motions, const std::filesystem::path& base_folder,
                SceneDescription& description);

/// [[fill]].
std::vector<FillDescription> read_fills(TomlTable& file, const dem_gpu::Scene& scene,
                                        const std::filesystem::path& base_folder);

/// [[chain]].
std::vector<ChainDescription> read_chains(TomlTable& file, const dem_gpu::Scene& scene,
                                          const std::filesystem::path& base_folder);

/// The catalogue's shapes that a table asks for.
CatalogueShapes read_catalogue_shapes(TomlTable& table, const std::filesystem::path& base_folder);
/// `ring = {...}`.
RingShape read_ring(TomlTable ring);

/// `size` of a fill.
void read_size_distribution(TomlTable& table, FillDescription& fill);

}  // namespace workflows
