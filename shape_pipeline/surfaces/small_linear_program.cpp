// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/small_linear_program.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace shape_pipeline {
namespace {

constexpr double kSlack = 1e-12;  // of a row of length about 1, in units of the reach: rounding

/// factor . x <= limit
struct Row {
  std::vector<double> factor;
  double limit = 0;
};

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// The row on the plane where `plane` holds with equality, its unknown `gone` put in terms of the others.
Row reduced(const Row& row, const Row& plane, std::size_t gone) {
  const double share = row.factor[gone] / plane.factor[gone];
  Row result;
  for (std::size_t i = 0; i < row.factor.size(); ++i)
    if (i != gone) result.factor.push_back(row.factor[i] - share * plane.factor[i]);
  result.limit = row.limit - share * plane.limit;
  return result;
}

/// x that makes goal . x largest under the rows and |x_i| <= box (Seidel 1991): rows are added one by one, and one
/// that the best point breaks holds with equality at the new best point. None if no point keeps all rows.
std::optional<std::vector<double>> best_point(const std::vector<Row>& rows, const std::vector<double>& goal,
                                              double box) {
  std::vector<double> best;
  for (const double g : goal) best.push_back(g >= 0 ? box : -box);
  if (goal.size() == 1) {
    double low = -box, high = box;
    for (const Row& row : rows) {
      const double factor = row.factor[0];
      if (factor > kSlack) high = std::min(high, row.limit / factor);
      if (factor < -kSlack) low = std::max(low, row.limit / factor);
    }
    if (low > high + kSlack * box) return std::nullopt;
    return std::vector<double>{goal[0] >= 0 ? high : low};
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Row& plane = rows[r];
    if (product(plane.factor, best) <= plane.limit + kSlack) continue;
    const auto largest = std::max_element(plane.factor.begin(), plane.factor.end(),
                                          [](double a, double b) { return std::abs(a) < std::abs(b); });
    const auto gone = static_cast<std::size_t>(largest - plane.factor.begin());
    if (std::abs(*largest) < kSlack) return std::nullopt;
    std::vector<Row> held;
    for (std::size_t k = 0; k < r; ++k) held.push_back(reduced(rows[k], plane, gone));
    for (const double side : {1.0, -1.0}) {
      Row wall{std::vector<double>(goal.size(), 0.0), box};
      wall.factor[gone] = side;
      held.push_back(reduced(wall, plane, gone));
    }
    auto others = best_point(held, reduced({goal, 0}, plane, gone).factor, box);
    if (!others) return std::nullopt;
    others->insert(others->begin() + static_cast<std::ptrdiff_t>(gone), 0.0);
    (*others)[gone] = (plane.limit - product(plane.factor, *others)) / plane.factor[gone];
    best = std::move(*others);
  }
  return best;
}

}  // namespace

std::array<double, 3> raising_step(const std::vector<LinearBound>& bounds, double reach) {
  if (bounds.empty()) return {};
  const auto least = std::min_element(bounds.begin(), bounds.end(),
                                      [](const LinearBound& a, const LinearBound& b) { return a.value < b.value; });
  // Unknowns: the step over the reach, and the gain of the level over twice the reach: a unit gradient allows no more.
  std::vector<Row> rows;
  for (const LinearBound& bound : bounds)
    rows.push_back(
        {{-bound.gradient[0], -bound.gradient[1], -bound.gradient[2], 2.0}, (bound.value - least->value) / reach});
  const auto best = best_point(rows, {0, 0, 0, 1}, 1);
  if (!best) return {};
  return {(*best)[0] * reach, (*best)[1] * reach, (*best)[2] * reach};
}

}  // namespace shape_pipeline
