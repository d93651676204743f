// SPDX-License-Identifier: Apache-2.0
#include "workflows/population/stratified_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "workflows/population/population_comparison.h"
#include "workflows/shape_sampling.h"

namespace workflows {
namespace {

constexpr std::size_t kMostDraws = 64, kFewestDraws = 4;
constexpr std::size_t kRowsLookedAt = 640000;  // by all draws together: half a second

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

double difference_of(const PopulationComparison& comparison) {
  double sum = 0;
  for (const FigureComparison& figure : comparison.figures) {
    if (!(figure.reference.spread > 0)) continue;
    sum += std::pow((figure.made.mean - figure.reference.mean) / figure.reference.spread, 2);
    sum += std::pow(figure.made.spread / figure.reference.spread - 1, 2);
  }
  for (const CorrelationComparison& pair : comparison.correlations) sum += std::pow(pair.made - pair.reference, 2);
  return sum;
}

}  // namespace

std::vector<std::size_t> stratified_rows(const std::vector<FormRow>& rows, std::size_t count, std::uint64_t seed) {
  return Strata(rows, seed).draw(count);
}

std::vector<std::size_t> representative_rows(const std::vector<FormRow>& rows, std::size_t count, std::uint64_t seed) {
  RandomSource random(seed);
  std::vector<std::size_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t draws = std::clamp(kRowsLookedAt / rows.size(), kFewestDraws, kMostDraws);
  for (std::size_t k = 0; k < draws; ++k) {
    std::vector<std::size_t> drawn = stratified_rows(rows, count, random.next());
    std::vector<FormRow> made;
    for (const std::size_t row : drawn) made.push_back(rows[row]);
    const double difference = difference_of(compare_populations(rows, made, Samples::drawn_from_reference));
    if (difference < least) {
      least = difference;
      nearest = std::move(drawn);
    }
  }
  return nearest;
}

}  // namespace workflows
