// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/volumes/grain_surface.h"

#include <algorithm>
#include <cmath>

#include "shape_pipeline/volumes/level_surface.h"

namespace shape_pipeline {
namespace {

constexpr double kCutSpread = 1.2;   // [voxels]: smooths the stairs of a cut, keeps a neck of a few voxels
constexpr int kReach = 4;            // of that Gaussian [voxels]
constexpr int kMargin = kReach + 1;  // about the grain: its spread ends within the box

/// A grain's neighbourhood in the stack; what lies beyond the stack's border is background.
struct Box {
  VoxelGrid grid;
  std::array<int, 3> low{};  // place of its first voxel in the stack

  Box(const VoxelGrid& stack, const LabelledGrain& grain) {
    grid.spacing = stack.spacing;
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = grain.low[i] - kMargin;
      grid.size[i] = grain.high[i] - grain.low[i] + 1 + 2 * kMargin;
    }
  }

  /// Calls visit(index in the box, index in the stack) for each voxel of the box that the stack has.
  template <class Visit>
  void for_each(const VoxelGrid& stack, Visit visit) const {
    const auto first = [&](std::size_t i) { return std::max(0, -low[i]); };
    const auto end = [&](std::size_t i) { return std::min(grid.size[i], stack.size[i] - low[i]); };
    for (int z = first(2); z < end(2); ++z)
      for (int y = first(1); y < end(1); ++y)
        for (int x = first(0); x < end(0); ++x)
          visit(grid.index(x, y, z), stack.index(x + low[0], y + low[1], z + low[2]));
  }
};

/// (grey - threshold) / (bright - dark)
std::vector<float> grey_field(const GreyVolume& volume, const GreyClasses& classes, const Box& box) {
  const double scale = 1 / std::max(classes.bright - classes.dark, 1.0);
  std::vector<float> field(box.grid.count(), static_cast<float>(scale * (classes.dark - classes.threshold) - 0.01));
  std::visit(
      [&](const auto& values) {
        box.for_each(volume.grid, [&](std::size_t b, std::size_t s) {
          field[b] = static_cast<float>(scale * (values[s] - classes.threshold));
        });
      },
      volume.values);
  return field;
}

/// Convolves along one axis with a Gaussian; nothing lies beyond the box.
void spread_along(std::vector<float>& field, const VoxelGrid& grid, std::size_t axis) {
  std::array<float, kReach + 1> weights;
  for (int k = 0; k <= kReach; ++k)
    weights[static_cast<std::size_t>(k)] = static_cast<float>(std::exp(-0.5 * k * k / (kCutSpread * kCutSpread)));
  const std::array<std::size_t, 3> stride{1, grid.index(0, 1, 0), grid.index(0, 0, 1)};
  const int count = grid.size[axis];
  std::vector<float> line(static_cast<std::size_t>(count + 2 * kReach));
  const std::size_t u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  for (int j = 0; j < grid.size[v]; ++j)
    for (int i = 0; i < grid.size[u]; ++i) {
      float* const start = &field[static_cast<std::size_t>(i) * stride[u] + static_cast<std::size_t>(j) * stride[v]];
      for (int n = 0; n < count; ++n)
        line[static_cast<std::size_t>(n + kReach)] = start[static_cast<std::size_t>(n) * stride[axis]];
      for (int n = 0; n < count; ++n) {
        const float* const middle = &line[static_cast<std::size_t>(n + kReach)];
        float sum = weights[0] * middle[0];
        for (int k = 1; k <= kReach; ++k) sum += weights[static_cast<std::size_t>(k)] * (middle[k] + middle[-k]);
        start[static_cast<std::size_t>(n) * stride[axis]] = sum;
      }
    }
}

/// Lowers the field to (own - others) / (own + others) / 2 of the spread labels, which is 0 along cuts and their
/// continuation into the background.
void cut_from_others(std::vector<float>& field, const GrainLabels& labels, const VoxelGrid& stack, const Box& box,
                     std::uint32_t own_label) {
  std::vector<float> own(field.size(), 0), others(field.size(), 0);
  bool has_others = false;
  box.for_each(stack, [&](std::size_t b, std::size_t s) {
    const std::uint32_t label = labels.labels[s];
    if (label == own_label) own[b] = 1;
    if (label != 0 && label != own_label) {
      others[b] = 1;
      has_others = true;
    }
  });
  if (!has_others) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    spread_along(own, box.grid, axis);
    spread_along(others, box.grid, axis);
  }
  for (std::size_t i = 0; i < field.size(); ++i)
    if (others[i] > 0) field[i] = std::min(field[i], (own[i] - others[i]) / (own[i] + others[i]) / 2);
}

}  // namespace

catalog::TriangleMesh grain_surface(const GreyVolume& volume, const GreyClasses& classes, const GrainLabels& labels,
                                    std::size_t grain) {
  const Box box(volume.grid, labels.grains[grain]);
  std::vector<float> field = grey_field(volume, classes, box);
  cut_from_others(field, labels, volume.grid, box, static_cast<std::uint32_t>(grain + 1));
  catalog::TriangleMesh mesh = level_surface(field, box.grid);
  for (catalog::Point& vertex : mesh.vertices)
    for (std::size_t i = 0; i < 3; ++i) vertex[i] += box.low[i] * box.grid.spacing[i];
  return mesh;
}

}  // namespace shape_pipeline
