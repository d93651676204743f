// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/surfaces/small_linear_program.h"

#include <CGAL/Gmpzf.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

namespace shape_pipeline {

std::array<double, 3> raising_step(const std::vector<LinearBound>& bounds, double reach) {
  using Program = CGAL::Quadratic_program<double>;
  constexpr int kLevel = 3;  // the fourth unknown, after the step's components
  Program program(CGAL::LARGER, false, 0, false, 0);
  for (int i = 0; i < 3; ++i) {
    program.set_l(i, true, -reach);
    program.set_u(i, true, reach);
  }
  program.set_c(kLevel, -1);
  for (int row = 0; row < static_cast<int>(bounds.size()); ++row) {
    for (int i = 0; i < 3; ++i) program.set_a(i, row, bounds[row].gradient[i]);
    program.set_a(kLevel, row, -1);
    program.set_b(row, -bounds[row].value);
  }
  const auto solution = CGAL::solve_linear_program(program, CGAL::Gmpzf());
  std::array<double, 3> step{};
  if (!solution.is_optimal()) return step;
  auto value = solution.variable_values_begin();
  for (double& component : step) component = CGAL::to_double(*value++);
  return step;
}

}  // namespace shape_pipeline
