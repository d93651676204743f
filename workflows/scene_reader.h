// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "dem_gpu/scene.h"
#include "workflows/chain.h"
#include "workflows/fill.h"
#include "workflows/level_choice.h"
#include "workflows/ring_shape.h"
#include "workflows/size_distribution.h"

namespace workflows {

/// A level of detail of every shape that a catalogue query selects.
struct CatalogueShapes {
  std::filesystem::path catalogue;  // found from the scene file's folder
  std::string query;                // see catalog::ShapeCatalog::select
  std::optional<int> parts;         // parts asked for: 1, 2, 4, 8, ...; nullopt: by tolerance
  std::optional<double> tolerance;  // else: the cheapest level of at most this symmetric difference [-]
  /// Those that come into question. Without a cap of vertices: by number of parts the one nearest to kUsualVertexCap
  /// that the catalogue has, by tolerance any. Without one of faces: by number of parts levels that have none, by
  /// tolerance any.
  LevelFilter levels;
};
inline constexpr int kUsualVertexCap = 32;

struct BallShape {
  double diameter = 1;  // [m]
};
struct BoxShape {
  Point size{};  // edges [m]
};

using ShapeSource = std::variant<CatalogueShapes, BallShape, BoxShape, RingShape>;

/// One [[fill]]: which bodies, how many, how large, where.
struct FillDescription {
  std::string name;
  std::string place;  // "scene.toml:12:1: fill "ore"", for messages
  ShapeSource shapes;
  int material = 0;                                             // index into Scene::materials
  std::variant<std::int64_t, double> amount = std::int64_t{0};  // number of bodies, or mass [kg]
  std::optional<SizeDistribution> size;                         // nullopt: shapes as they are
  SizeDefinition definition = SizeDefinition::volume_equivalent;
  FillRegion region;
  FillLayout layout;
  Point velocity{};  // at time 0 [m/s]
};

/// One [[chain]]: links of one shape.
struct ChainDescription {
  std::string name;
  std::string place;  // "scene.toml:12:1: chain "hoist"", for messages
  ShapeSource link;
  int material = 0;  // index into Scene::materials
  ChainLayout layout;
  Point velocity{};  // of the links that are not held, at time 0 [m/s]
};

/// How the stiffness of contacts follows: given, or from the overlap allowed at an impact speed.
struct StiffnessChoice {
  std::optional<double> polyhedra;        // [N/m3]
  std::optional<double> spheres;          // [N/m]
  std::optional<double> largest_overlap;  // share of the body's equivalent diameter [-]
  dem_gpu::OverlapAt overlap_at = dem_gpu::OverlapAt::face;
  double at_speed = 0;  // [m/s]
};

/// A scene file as written: everything that needs neither catalogue nor engine.
struct SceneDescription {
  std::filesystem::path file;
  /// "scene.toml:4:1" of the sections, by what the engine's messages about each begin with: "wall 'gate'".
  std::map<std::string, std::string> places;
  std::string text;                  // the file's bytes
  dem_gpu::Scene scene;              // without shapes and bodies; stiffness still to be worked out
  std::vector<std::string> motions;  // names of the [motion.NAME] sections
  StiffnessChoice stiffness;
  std::vector<FillDescription> fills;
  std::vector<ChainDescription> chains;
};

/// Reads a scene file. Relative paths in it start from `base_folder`, or the file's folder if that is empty.
/// Throws catalog::InputError "file:line:column: ..." for anything unknown, missing, of a wrong type or out of range.
SceneDescription read_scene(const std::filesystem::path& file, const std::filesystem::path& base_folder = {});

/// The same from text; `file` is the name used in messages.
SceneDescription read_scene_text(std::string text, const std::filesystem::path& file,
                                 const std::filesystem::path& base_folder);

}  // namespace workflows
