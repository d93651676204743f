// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "workflows/scene_reader.h"

namespace workflows {

/// A shape in the scene and how far it is from the particle it stands for.
struct ShapeReport {
  std::string name;
  int parts = 0;
  int vertices = 0;                 // of all parts
  int faces = 0;                    // of all parts
  double volume = 0;                // at scale 1 [m3]
  double symmetric_difference = 0;  // against the digitised mesh / its volume [-]; 0 for balls and boxes
  double volume_error = 0;          // signed, the same [-]
};

struct FillReport {
  std::string name;
  int first_body = 0;
  int bodies = 0;
  double mass = 0;  // [kg]
  RealisedSizes realised;
};

struct ChainReport {
  std::string name;
  int first_body = 0;
  int bodies = 0;
  double mass = 0;  // [kg]
};

struct CatalogueUsed {
  std::filesystem::path path;
  std::string sha256;
};

/// A scene ready for the engine, with what the report needs to say about it.
struct AssembledScene {
  dem_gpu::Scene scene;
  std::vector<ShapeReport> shapes;  // as Scene::shapes
  std::vector<FillReport> fills;    // as SceneDescription::fills
  std::vector<ChainReport> chains;  // as SceneDescription::chains; their bodies stand behind the fills'
  std::vector<CatalogueUsed> catalogues;
};

/// Fetches shapes, draws sizes, sets bodies into their regions and works out the stiffness. The same description and
/// catalogue give the same scene, bit for bit.
/// Throws catalog::InputError for a query that selects nothing, a level of detail that is missing, bodies that do not
/// fit, and bodies that would start inside one another or in a wall.
AssembledScene assemble_scene(const SceneDescription& description);

}  // namespace workflows
