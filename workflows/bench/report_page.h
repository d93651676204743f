// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "workflows/bench/bench_plan.h"

namespace workflows {

// What benches with a page of their own share.

/// Figures by case and name; those that are not there, or failed, are not numbers.
class FigureTable {
 public:
  explicit FigureTable(const std::vector<ReportedFigure>& figures);
  double operator()(const std::string& case_name, const std::string& figure) const;

 private:
  std::map<std::pair<std::string, std::string>, double> values_;
};

/// A Markdown table whose columns are as wide as their widest cell, so that it reads on a terminal too; all but the
/// first two columns are aligned to the right. The first row is the header.
std::string aligned_markdown(const std::vector<std::vector<std::string>>& rows);

/// "4.21"; "-" for what is not a number.
std::string fixed(double value, int decimals);

/// The name its maker gave this machine's processor.
std::string processor_name();

/// UTC, such as "2026-11-22".
std::string today();

}  // namespace workflows
