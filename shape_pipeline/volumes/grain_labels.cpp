// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/volumes/grain_labels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shape_pipeline/volumes/distance_transform.h"

namespace shape_pipeline {
namespace {

// A voxel's word holds its distance until the flood reaches it, then its basin with these marks.
constexpr std::uint32_t kIsLabelled = 1u << 31;
constexpr std::uint32_t kIsFlooded = 1u << 30;  // its neighbours were looked at
constexpr std::uint32_t kBasin = kIsFlooded - 1;

/// Basins that grow together.
class Basins {
 public:
  explicit Basins(const SeparationOptions& options) : options_(options) {}

  std::uint32_t add(std::uint32_t peak) {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    peak_.push_back(peak);
    return parent_.back();
  }

  std::uint32_t root(std::uint32_t basin) {
    while (parent_[basin] != basin) basin = parent_[basin] = parent_[parent_[basin]];
    return basin;
  }

  /// For two roots whose basins meet at a saddle. Saddles come from high to low and peaks only rise, so that two basins
  /// kept apart stay apart.
  void meet(std::uint32_t a, std::uint32_t b, std::uint32_t saddle) {
    const double lower_peak = std::min(peak_[a], peak_[b]);
    const bool is_neck =
        saddle < options_.neck_ratio * lower_peak && lower_peak - saddle > options_.least_depth * kDistanceSteps;
    if (is_neck) return;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    peak_[a] = std::max(peak_[a], peak_[b]);
  }

  std::size_t count() const { return parent_.size(); }

 private:
  SeparationOptions options_;
  std::vector<std::uint32_t> parent_, peak_;
};

/// Calls visit(index) for the 26 neighbours of a voxel that lie in the grid; an earlier one has the lower index.
template <class Visit>
void for_each_neighbour(const VoxelGrid& grid, std::size_t voxel, Visit visit) {
  const std::size_t nx = static_cast<std::size_t>(grid.size[0]), slice = nx * static_cast<std::size_t>(grid.size[1]);
  const int z = static_cast<int>(voxel / slice), y = static_cast<int>(voxel % slice / nx),
            x = static_cast<int>(voxel % nx);
  for (int w = std::max(z - 1, 0); w <= std::min(z + 1, grid.size[2] - 1); ++w)
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, grid.size[1] - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, grid.size[0] - 1); ++u)
        if (u != x || v != y || w != z) visit(grid.index(u, v, w));
}

class Flood {
 public:
  Flood(std::vector<std::uint32_t>& words, const VoxelGrid& grid, const SeparationOptions& options)
      : words_(words), grid_(grid), basins_(options) {}

  void run() {
    seed_peaks();
    for (level_ = front_.size(); level_-- > 1;) {
      // Voxels of this level may still be added to the bucket while it is worked through.
      for (std::size_t i = 0; i < front_[level_].size(); ++i) flood_from(front_[level_][i]);
      std::vector<std::uint32_t>().swap(front_[level_]);
    }
  }

  Basins& basins() { return basins_; }

 private:
  /// A basin for the first voxel of each plateau that no neighbour tops; plateaus of several such voxels grow together.
  void seed_peaks() {
    std::vector<std::uint32_t> peaks;
    std::uint32_t highest = 0;
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if (words_[i] == 0) continue;
      bool is_peak = true;
      for_each_neighbour(grid_, i,
                         [&](std::size_t j) { is_peak &= j < i ? words_[j] < words_[i] : words_[j] <= words_[i]; });
      if (is_peak) peaks.push_back(static_cast<std::uint32_t>(i));
      highest = std::max(highest, words_[i]);
    }
    front_.resize(std::size_t{highest} + 1);
    for (const std::uint32_t peak : peaks) join(peak, basins_.add(words_[peak]));
  }

  void join(std::size_t voxel, std::uint32_t basin) {
    front_[words_[voxel]].push_back(static_cast<std::uint32_t>(voxel));
    words_[voxel] = kIsLabelled | basin;
  }

  void flood_from(std::uint32_t voxel) {
    words_[voxel] |= kIsFlooded;
    for_each_neighbour(grid_, voxel, [&](std::size_t j) {
      const std::uint32_t word = words_[j];
      if (word == 0) return;
      const std::uint32_t own = basins_.root(words_[voxel] & kBasin);
      if (!(word & kIsLabelled)) return join(j, own);
      if (!(word & kIsFlooded)) return;  // a lower saddle, looked at from there
      const std::uint32_t other = basins_.root(word & kBasin);
      if (other != own) basins_.meet(own, other, static_cast<std::uint32_t>(level_));
    });
  }

  std::vector<std::uint32_t>& words_;
  const VoxelGrid& grid_;
  Basins basins_;
  std::vector<std::vector<std::uint32_t>> front_;  // voxels to flood from, by distance
  std::size_t level_ = 0;
};

void include(LabelledGrain& grain, const std::array<int, 3>& at, const VoxelGrid& grid) {
  if (grain.voxels++ == 0) grain.low = grain.high = at;
  for (std::size_t i = 0; i < 3; ++i) {
    grain.low[i] = std::min(grain.low[i], at[i]);
    grain.high[i] = std::max(grain.high[i], at[i]);
    grain.touches_border |= at[i] == 0 || at[i] == grid.size[i] - 1;
  }
}

/// Numbers the basins that are left in the order of their first voxels and measures them.
void number_grains(GrainLabels& result, Basins& basins, const VoxelGrid& grid) {
  std::vector<std::uint32_t> number(basins.count(), 0);
  std::size_t i = 0;
  for (int z = 0; z < grid.size[2]; ++z)
    for (int y = 0; y < grid.size[1]; ++y)
      for (int x = 0; x < grid.size[0]; ++x, ++i) {
        std::uint32_t& word = result.labels[i];
        if (word == 0) continue;
        std::uint32_t& label = number[basins.root(word & kBasin)];
        if (label == 0) {
          result.grains.emplace_back();
          label = static_cast<std::uint32_t>(result.grains.size());
        }
        word = label;
        include(result.grains[label - 1], {x, y, z}, grid);
      }
}

}  // namespace

GrainLabels separate_grains(const GreyVolume& volume, double threshold, const SeparationOptions& options) {
  GrainLabels result;
  result.labels.resize(volume.grid.count());
  std::visit(
      [&](const auto& values) {
        for (std::size_t i = 0; i < values.size(); ++i) result.labels[i] = values[i] >= threshold ? 1 : 0;
      },
      volume.values);
  distance_transform(result.labels, volume.grid);
  Flood flood(result.labels, volume.grid, options);
  flood.run();
  number_grains(result, flood.basins(), volume.grid);
  return result;
}

}  // namespace shape_pipeline
