// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/volumes/grey_filters.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>

namespace shape_pipeline {
namespace {

template <class Value>
std::vector<Value> slice_of(const std::vector<Value>& values, const VoxelGrid& grid, int z) {
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(grid.index(0, 0, std::clamp(z, 0, grid.size[2] - 1)));
  return {begin, begin + static_cast<std::ptrdiff_t>(grid.index(0, 0, 1))};
}

/// Slides a window of 2 * reach + 1 prepared slices through the volume: `prepare` a slice that was not changed yet,
/// `combine` the window into the slice in its middle.
template <class Value, class Prepare, class Combine>
void slide_through(std::vector<Value>& values, const VoxelGrid& grid, int reach, Prepare prepare, Combine combine) {
  using Slice = decltype(prepare(slice_of(values, grid, 0)));
  std::deque<Slice> window;
  for (int z = -reach; z < reach; ++z) window.push_back(prepare(slice_of(values, grid, z)));
  for (int z = 0; z < grid.size[2]; ++z) {
    // Beyond the last slice, which is overwritten only after it came into the window, its copy is repeated.
    window.push_back(z + reach < grid.size[2] ? prepare(slice_of(values, grid, z + reach)) : window.back());
    combine(window, values.data() + grid.index(0, 0, z));
    window.pop_front();
  }
}

constexpr std::size_t kLanes = 64;  // voxels of a row that are sorted side by side, in vector instructions

template <class Value>
using Lanes = std::array<Value, kLanes>;

/// The smaller values to `low`, the larger to `high`, lane by lane.
template <class Value>
void exchange(Lanes<Value>& low, Lanes<Value>& high) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Value a = low[i], b = high[i];
    low[i] = std::min(a, b);
    high[i] = std::max(a, b);
  }
}

/// Median of the 27 values of each lane, left in place 13: of any 15 of them the least and the largest cannot be it,
/// nor of the 13 others with the next one, and so on down to three.
template <class Value>
void select_median(std::array<Lanes<Value>, 27>& near) {
  constexpr std::size_t first = 12;  // the values in play stand from here to `last`, those before wait
  for (std::size_t last = 26;; --last) {
    const std::size_t count = last - first + 1;
    for (std::size_t i = 0; i < count / 2; ++i) exchange(near[first + i], near[last - i]);
    for (std::size_t i = 1; i < (count + 1) / 2; ++i) {
      exchange(near[first], near[first + i]);
      exchange(near[last - i], near[last]);
    }
    if (count == 3) return;
    near[first] = near[26 - last];
  }
}

/// A slice with its outermost layer repeated by one voxel on all sides, and filled up to whole lanes.
template <class Value>
struct PaddedSlice {
  std::size_t width;
  std::vector<Value> values;

  PaddedSlice(const std::vector<Value>& slice, const VoxelGrid& grid)
      : width((static_cast<std::size_t>(grid.size[0]) + kLanes - 1) / kLanes * kLanes + 2) {
    values.reserve(width * (static_cast<std::size_t>(grid.size[1]) + 2));
    for (int y = -1; y <= grid.size[1]; ++y)
      for (int x = -1; x + 1 < static_cast<int>(width); ++x)
        values.push_back(slice[grid.index(std::clamp(x, 0, grid.size[0] - 1), std::clamp(y, 0, grid.size[1] - 1), 0)]);
  }
};

template <class Value>
void filter_median(std::vector<Value>& values, const VoxelGrid& grid) {
  const auto pad = [&](const std::vector<Value>& slice) { return PaddedSlice<Value>(slice, grid); };
  const std::size_t nx = static_cast<std::size_t>(grid.size[0]);
  slide_through(values, grid, 1, pad, [&](const std::deque<PaddedSlice<Value>>& window, Value* out) {
    std::array<Lanes<Value>, 27> near;
    for (std::size_t y = 0; y < static_cast<std::size_t>(grid.size[1]); ++y)
      for (std::size_t x = 0; x < nx; x += kLanes) {
        std::size_t n = 0;
        for (const PaddedSlice<Value>& slice : window)
          for (std::size_t v = y; v < y + 3; ++v)
            for (std::size_t u = x; u < x + 3; ++u)
              std::copy_n(&slice.values[v * slice.width + u], kLanes, near[n++].begin());
        select_median(near);
        std::copy_n(near[13].begin(), std::min(kLanes, nx - x), out + y * nx + x);
      }
  });
}

std::vector<float> gaussian_weights(double sigma, int reach) {
  std::vector<float> weights;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += std::exp(-0.5 * i * i / (sigma * sigma));
  for (int i = -reach; i <= reach; ++i)
    weights.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma)) / sum));
  return weights;
}

/// One line of `count` values `stride` apart, convolved in place.
void convolve_line(float* line, int count, std::size_t stride, const std::vector<float>& weights,
                   std::vector<float>& scratch) {
  const int reach = static_cast<int>(weights.size() / 2);
  scratch.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) scratch[static_cast<std::size_t>(i)] = line[static_cast<std::size_t>(i) * stride];
  for (int i = 0; i < count; ++i) {
    float sum = 0;
    for (int k = -reach; k <= reach; ++k)
      sum += weights[static_cast<std::size_t>(k + reach)] *
             scratch[static_cast<std::size_t>(std::clamp(i + k, 0, count - 1))];
    line[static_cast<std::size_t>(i) * stride] = sum;
  }
}

template <class Value>
void filter_gaussian(std::vector<Value>& values, const VoxelGrid& grid, double sigma) {
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  const std::vector<float> weights = gaussian_weights(sigma, reach);
  const std::size_t nx = static_cast<std::size_t>(grid.size[0]);
  std::vector<float> scratch;
  const auto blur_slice = [&](const std::vector<Value>& slice) {
    std::vector<float> blurred(slice.begin(), slice.end());
    for (std::size_t y = 0; y < static_cast<std::size_t>(grid.size[1]); ++y)
      convolve_line(&blurred[y * nx], grid.size[0], 1, weights, scratch);
    for (std::size_t x = 0; x < nx; ++x) convolve_line(&blurred[x], grid.size[1], nx, weights, scratch);
    return blurred;
  };
  slide_through(values, grid, reach, blur_slice, [&](const std::deque<std::vector<float>>& window, Value* out) {
    for (std::size_t i = 0; i < window.front().size(); ++i) {
      float sum = 0;
      for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * window[k][i];
      out[i] = static_cast<Value>(std::lround(sum));
    }
  });
}

std::vector<double> histogram(const GreyVolume& volume) {
  return std::visit(
      [](const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        std::vector<double> counts(std::size_t{std::numeric_limits<Value>::max()} + 1);
        for (const Value value : values) ++counts[value];
        return counts;
      },
      volume.values);
}

/// The classes of the values below `first_bright` and of those from there on.
GreyClasses parted_at(const std::vector<double>& counts, std::size_t first_bright) {
  std::array<double, 2> number{}, sum{};
  double squares = 0;
  for (std::size_t g = 0; g < counts.size(); ++g) {
    const std::size_t side = g < first_bright ? 0 : 1;
    const double grey = static_cast<double>(g);
    number[side] += counts[g];
    sum[side] += counts[g] * grey;
    squares += counts[g] * grey * grey;
  }
  GreyClasses classes;
  classes.dark = number[0] > 0 ? sum[0] / number[0] : 0;
  classes.bright = number[1] > 0 ? sum[1] / number[1] : 0;
  const double all = number[0] + number[1], mean = (sum[0] + sum[1]) / all, variance = squares / all - mean * mean;
  if (variance > 0 && number[0] > 0 && number[1] > 0)
    classes.separability = number[0] / all * (number[1] / all) * std::pow(classes.bright - classes.dark, 2) / variance;
  return classes;
}

constexpr double kLeastPlateau = 1000;  // voxels that tell a median to a fraction of a grey value

double total(const std::vector<double>& counts) { return std::accumulate(counts.begin(), counts.end(), 0.0); }

/// Interpolated within the grey value that holds the middle.
double median_of(const std::vector<double>& counts) {
  double left = total(counts) / 2;
  std::size_t g = 0;
  for (; left > counts[g]; ++g) left -= counts[g];
  return static_cast<double>(g) - 0.5 + left / counts[g];
}

/// Histograms of the voxels that lie, with those `reach` before and behind along each axis and all between, on the dark
/// or on the bright side of a threshold, and of those near surfaces.
struct PlateauCounts {
  std::vector<double> dark, bright, near_surface;
};

template <class Value>
PlateauCounts plateau_counts(const std::vector<Value>& values, const VoxelGrid& grid, double threshold, int reach) {
  const std::vector<double> none(std::size_t{std::numeric_limits<Value>::max()} + 1);
  PlateauCounts counts{none, none, none};
  const std::array<std::size_t, 3> stride{1, grid.index(0, 1, 0), grid.index(0, 0, 1)};
  for (int z = reach; z < grid.size[2] - reach; ++z)
    for (int y = reach; y < grid.size[1] - reach; ++y)
      for (int x = reach; x < grid.size[0] - reach; ++x) {
        const std::size_t i = grid.index(x, y, z);
        const bool is_bright = values[i] >= threshold;
        bool is_deep = true;
        for (std::size_t axis = 0; axis < 3 && is_deep; ++axis)
          for (std::size_t k = 1; k <= static_cast<std::size_t>(reach) && is_deep; ++k)
            is_deep = (values[i - k * stride[axis]] >= threshold) == is_bright &&
                      (values[i + k * stride[axis]] >= threshold) == is_bright;
        ++(!is_deep ? counts.near_surface : is_bright ? counts.bright : counts.dark)[values[i]];
      }
  return counts;
}

/// The threshold that as many voxels near surfaces reach as their grey values add up to whole ones: the middle of those
/// for which this holds to 0.5 % of these voxels, since where edges are sharp a wide range does.
double volume_true_threshold(const std::vector<double>& counts, double dark, double bright) {
  double filled = 0;
  for (std::size_t g = 0; g < counts.size(); ++g)
    filled += counts[g] * (static_cast<double>(g) - dark) / (bright - dark);
  const double tolerance = 0.005 * total(counts);
  const auto threshold_of = [&](double wanted) {
    double above = 0;
    for (std::size_t g = counts.size(); g-- > 0; above += counts[g])
      if (above + counts[g] >= wanted && counts[g] > 0)
        return static_cast<double>(g) + 0.5 - std::clamp((wanted - above) / counts[g], 0.0, 1.0);
    return dark;
  };
  return (threshold_of(filled - tolerance) + threshold_of(filled + tolerance)) / 2;
}

}  // namespace

void median_filter(GreyVolume& volume) {
  std::visit([&](auto& values) { filter_median(values, volume.grid); }, volume.values);
}

void gaussian_filter(GreyVolume& volume, double sigma) {
  std::visit([&](auto& values) { filter_gaussian(values, volume.grid, sigma); }, volume.values);
}

GreyClasses otsu_classes(const GreyVolume& volume) {
  const std::vector<double> counts = histogram(volume);
  double all = 0, moment = 0;
  for (std::size_t g = 0; g < counts.size(); ++g) {
    all += counts[g];
    moment += counts[g] * static_cast<double>(g);
  }
  double below = 0, moment_below = 0, best = -1;
  std::size_t first_bright = 1;
  for (std::size_t g = 0; g + 1 < counts.size(); ++g) {
    below += counts[g];
    moment_below += counts[g] * static_cast<double>(g);
    if (below == 0 || below == all) continue;
    const double between = std::pow(moment * below / all - moment_below, 2) / (below * (all - below));
    if (between > best) {
      best = between;
      first_bright = g + 1;
    }
  }
  GreyClasses classes = parted_at(counts, first_bright);
  classes.threshold = (classes.dark + classes.bright) / 2;
  return classes;
}

GreyClasses plateau_classes(const GreyVolume& volume) {
  GreyClasses classes = otsu_classes(volume);
  if (classes.separability == 0) return classes;
  std::visit(
      [&](const auto& values) {
        for (int reach = 3; reach > 0; --reach) {
          const PlateauCounts counts = plateau_counts(values, volume.grid, classes.threshold, reach);
          if (total(counts.dark) < kLeastPlateau || total(counts.bright) < kLeastPlateau) continue;
          classes.dark = median_of(counts.dark);
          classes.bright = median_of(counts.bright);
          classes.threshold = volume_true_threshold(counts.near_surface, classes.dark, classes.bright);
          return;
        }
      },
      volume.values);
  return classes;
}

GreyClasses classes_at(const GreyVolume& volume, double threshold) {
  const double first = std::clamp(std::ceil(threshold), 0.0, 65536.0);
  GreyClasses classes = parted_at(histogram(volume), static_cast<std::size_t>(first));
  classes.threshold = threshold;
  return classes;
}

}  // namespace shape_pipeline
