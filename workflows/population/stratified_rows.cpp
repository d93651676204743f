// SPDX-License-Identifier: Apache-2.0
#include "workflows/population/stratified_rows.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "workflows/shape_sampling.h"

namespace workflows {
namespace {

double variance(const std::vector<FormRow>& rows, std::span<const std::size_t> cell, std::size_t figure) {
  const auto count = static_cast<double>(cell.size());
  double mean = 0, sum = 0;
  for (const std::size_t row : cell) mean += rows[row][figure] / count;
  for (const std::size_t row : cell) sum += std::pow(rows[row][figure] - mean, 2) / count;
  return sum;
}

class Strata {
 public:
  Strata(const std::vector<FormRow>& rows, std::uint64_t seed) : rows_(rows), random_(seed), all_(rows.size()) {
    std::iota(all_.begin(), all_.end(), std::size_t{0});
    for (std::size_t c = 0; c < kFormFigures; ++c) whole_[c] = variance(rows, all_, c);
  }

  std::vector<std::size_t> draw(std::size_t count) {
    for (; count >= rows_.size(); count -= rows_.size()) drawn_.insert(drawn_.end(), all_.begin(), all_.end());
    std::vector<std::size_t> rows = all_;
    divide(rows, count);
    std::sort(drawn_.begin(), drawn_.end(), [&](std::size_t a, std::size_t b) {
      return std::tie(rows_[a][kDiameter], a) < std::tie(rows_[b][kDiameter], b);
    });
    return drawn_;
  }

 private:
  std::size_t widest(std::span<const std::size_t> cell) const {
    std::size_t widest = 0;
    double most = -1;
    for (std::size_t c = 0; c < kFormFigures; ++c) {
      const double share = whole_[c] > 0 ? variance(rows_, cell, c) / whole_[c] : 0;
      if (share > most) std::tie(widest, most) = std::tuple(c, share);
    }
    return widest;
  }

  void divide(std::span<std::size_t> cell, std::size_t count) {
    if (count == 0) return;
    if (count == 1) {
      drawn_.push_back(cell[random_.below(cell.size())]);
      return;
    }
    const std::size_t c = widest(cell), lower = count / 2;
    std::sort(cell.begin(), cell.end(),
              [&](std::size_t a, std::size_t b) { return std::tie(rows_[a][c], a) < std::tie(rows_[b][c], b); });
    // Rounded up or down by chance, so that no row is favoured.
    const double place = static_cast<double>(cell.size()) * static_cast<double>(lower) / static_cast<double>(count);
    const auto middle =
        std::clamp(static_cast<std::size_t>(place + random_.uniform()), lower, cell.size() - (count - lower));
    divide(cell.first(middle), lower);
    divide(cell.subspan(middle), count - lower);
  }

  const std::vector<FormRow>& rows_;
  RandomSource random_;
  std::vector<std::size_t> all_, drawn_;
  std::array<double, kFormFigures> whole_{};
};

}  // namespace

std::vector<std::size_t> stratified_rows(const std::vector<FormRow>& rows, std::size_t count, std::uint64_t seed) {
  return Strata(rows, seed).draw(count);
}

}  // namespace workflows
