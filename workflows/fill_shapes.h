// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "workflows/scene_assembly.h"

namespace workflows {

/// A shape that a fill may use.
struct FillShape {
  int index = 0;               // into Scene::shapes
  double size = 0;             // at scale 1, by the fill's size definition [m]
  double volume = 0;           // at scale 1 [m3]
  double bounding_radius = 0;  // about the centre of mass, at scale 1 [m]
};

/// Adds shapes to a scene, each once however many fills use it.
class ShapeCollector {
 public:
  explicit ShapeCollector(AssembledScene& assembled) : assembled_(assembled) {}

  /// All shapes that the fill draws from, at least one.
  std::vector<FillShape> shapes_of(const FillDescription& fill);

 private:
  struct Collected {
    FillShape shape;
    double sieve_size, largest_feret;  // at scale 1 [m]
  };

  Collected ball(const FillDescription& fill, const BallShape& ball);
  Collected box(const BoxShape& box);
  Collected ring(const RingShape& ring);
  std::vector<Collected> selected(const FillDescription& fill, const CatalogueShapes& shapes);
  Collected add(dem_gpu::Shape shape, ShapeReport report);

  AssembledScene& assembled_;
  std::map<std::string, Collected> collected_;  // by source, name and level
};

}  // namespace workflows
