// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/volumes/distance_transform.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace shape_pipeline {
namespace {

constexpr float kFar = 1e12f;  // squared distance, in smallest spacings, where no background was met yet

/// Lower envelope of parabolas along one line (Felzenszwalb & Huttenlocher 2012, algorithm 1).
class LineTransform {
 public:
  LineTransform(int count, double spacing)
      : count_(count),
        square_(static_cast<float>(spacing * spacing)),
        apex_(static_cast<std::size_t>(count)),
        start_(static_cast<std::size_t>(count) + 1),
        line_(static_cast<std::size_t>(count)) {}

  /// Squared distances [smallest spacings], as the bits of floats, `stride` apart; in place.
  void transform(std::uint32_t* voxels, std::size_t stride) {
    bool has_near = false;
    for (int i = 0; i < count_; ++i) {
      at(line_, i) = std::bit_cast<float>(voxels[static_cast<std::size_t>(i) * stride]);
      has_near |= at(line_, i) < kFar;
    }
    if (!has_near) return;
    build_envelope();
    int k = 0;
    for (int i = 0; i < count_; ++i) {
      while (at(start_, k + 1) < static_cast<float>(i)) ++k;
      const float arm = static_cast<float>(i - at(apex_, k));
      voxels[static_cast<std::size_t>(i) * stride] =
          std::bit_cast<std::uint32_t>(square_ * arm * arm + at(line_, at(apex_, k)));
    }
  }

 private:
  template <class T>
  static T& at(std::vector<T>& values, int i) {
    return values[static_cast<std::size_t>(i)];
  }

  void build_envelope() {
    int last = -1;
    for (int i = 0; i < count_; ++i) {
      if (at(line_, i) >= kFar) continue;
      float meets = -INFINITY;
      while (last >= 0) {
        meets = meeting(at(apex_, last), i);
        if (meets > at(start_, last)) break;
        --last;
      }
      ++last;
      at(apex_, last) = i;
      at(start_, last) = last == 0 ? -INFINITY : meets;
      at(start_, last + 1) = INFINITY;
    }
  }

  /// Where the parabolas over p < q are equally high, in double: the squares of far places lose the difference.
  float meeting(int p, int q) {
    const double height = (static_cast<double>(at(line_, q)) - static_cast<double>(at(line_, p))) / square_;
    return static_cast<float>((height + static_cast<double>(q) * q - static_cast<double>(p) * p) / (2.0 * (q - p)));
  }

  int count_;
  float square_;
  std::vector<int> apex_;
  std::vector<float> start_, line_;
};

}  // namespace

void distance_transform(std::vector<std::uint32_t>& voxels, const VoxelGrid& grid) {
  for (std::uint32_t& voxel : voxels) voxel = std::bit_cast<std::uint32_t>(voxel == 0 ? 0.0f : kFar);
  const double unit = *std::min_element(grid.spacing.begin(), grid.spacing.end());
  const std::array<std::size_t, 3> stride{1, grid.index(0, 1, 0), grid.index(0, 0, 1)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    LineTransform line(grid.size[axis], grid.spacing[axis] / unit);
    for (std::size_t j = 0; j < static_cast<std::size_t>(grid.size[v]); ++j)
      for (std::size_t i = 0; i < static_cast<std::size_t>(grid.size[u]); ++i)
        line.transform(&voxels[i * stride[u] + j * stride[v]], stride[axis]);
  }
  constexpr float kMostSteps = 1 << 20;  // far beyond half the largest stack: where there is no background at all
  for (std::uint32_t& voxel : voxels) {
    const float distance = std::sqrt(std::bit_cast<float>(voxel));
    voxel = distance > 0 ? static_cast<std::uint32_t>(std::clamp(kDistanceSteps * distance, 1.0f, kMostSteps)) : 0;
  }
}

}  // namespace shape_pipeline
