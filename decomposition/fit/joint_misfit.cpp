// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/fit/joint_misfit.h"

#include <limits>
#include <utility>

#include "decomposition/fit/column_measure.h"
#include "decomposition/fit/leaf_shape.h"
#include "decomposition/fit/sections.h"

namespace decomposition {

std::vector<std::vector<Vec3>> part_points(const Solid& solid, const Partition& partition) {
  SectionPolygons polygons;
  polygons.build(partition, kSameCorner * solid.diagonal());
  std::vector<std::vector<Vec3>> parts;
  for (const Leaf& leaf : partition.leaves) {
    LeafShape shape;
    shape.update(partition, leaf, polygons, solid.diagonal());
    parts.push_back(std::move(shape.points));
  }
  return parts;
}

double joint_misfit(const Solid& solid, const Partition& partition, int stride) {
  SectionPolygons sections;
  sections.build(partition, kSameCorner * solid.diagonal());
  ColumnMeasure measure(solid, stride);
  double misfit = 0;
  for (const Leaf& leaf : partition.leaves) {
    LeafShape shape;
    if (!shape.update(partition, leaf, sections, solid.diagonal())) return std::numeric_limits<double>::infinity();
    misfit += measure(shape.points, shape.hull.faces()).misfit();
  }
  return misfit;
}

}  // namespace decomposition
