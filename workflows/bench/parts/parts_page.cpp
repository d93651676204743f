// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/parts/parts_page.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "workflows/bench/parts/rock_bed.h"
#include "workflows/bench/report_page.h"

namespace workflows {
namespace {

using Cells = std::vector<std::string>;

/// Two beds that differ by less than this many standard deviations of one bed are not told apart.
constexpr double kTold = 3;

/// The measured levels of one shape.
class Levels {
 public:
  Levels(const FigureTable& figures, const PartsStudy& study) : figures_(figures), study_(study) {
    for (const PartsStudy::Row& row : study.rows)
      if (!std::isnan(error(row))) measured_.push_back(row);
  }

  const std::vector<PartsStudy::Row>& measured() const { return measured_; }
  double error(const PartsStudy::Row& row) const { return figures_(row.case_name, kLevelError); }
  double answer(const PartsStudy::Row& row, const std::string& name) const { return figures_(row.case_name, name); }
  double step_time(const PartsStudy::Row& row) const { return figures_(row.case_name, kStepTime); }
  double mean(const std::string& name) const { return figures_(study_.spread_case, mean_of(name)); }
  double deviation(const std::string& name) const { return figures_(study_.spread_case, deviation_of(name)); }

  const PartsStudy::Row& finest() const {
    return *std::min_element(measured_.begin(), measured_.end(),
                             [&](const auto& a, const auto& b) { return error(a) < error(b); });
  }

  /// Largest distance of an answer from that of the finest level, in standard deviations of one bed; not a number if
  /// one of them is missing.
  double distance(const PartsStudy::Row& row) const {
    double largest = 0;
    for (const char* name : kBedAnswers) {
      const double difference = std::abs(answer(row, name) - answer(finest(), name));
      const double off = difference == 0 && deviation(name) == 0 ? 0 : difference / deviation(name);
      largest = off > largest || std::isnan(off) ? off : largest;
      if (std::isnan(off)) break;
    }
    return largest;
  }

 private:
  const FigureTable& figures_;
  const PartsStudy& study_;
  std::vector<PartsStudy::Row> measured_;
};

std::string level_table(const Levels& levels) {
  std::vector<Cells> table{{"parts x vertices", "error %", "packing fraction", "slide angle deg", "half emptied s",
                            "left on the shelf", "off the finest, sd", "contacts a rock", "step ms"}};
  for (const PartsStudy::Row& row : levels.measured()) {
    table.push_back({row.level, fixed(100 * levels.error(row), 2)});
    const int decimals[] = {4, 2, 4, 3};
    for (std::size_t i = 0; i < std::size(kBedAnswers); ++i)
      table.back().push_back(fixed(levels.answer(row, kBedAnswers[i]), decimals[i]));
    table.back().push_back(fixed(levels.distance(row), 1));
    table.back().push_back(fixed(levels.answer(row, "contacts a rock [-]"), 2));
    table.back().push_back(fixed(levels.step_time(row), 1));
  }
  return aligned_markdown(table);
}

std::string spread_table(const Levels& levels) {
  std::vector<Cells> table{{"answer", "of", "mean", "standard deviation"}};
  for (const char* name : kBedAnswers)
    table.push_back({name, "one bed", fixed(levels.mean(name), 4), fixed(levels.deviation(name), 4)});
  return aligned_markdown(table);
}

/// The cheapest of the levels that, with all of less error, cannot be told from the finest; null if nothing is known.
const PartsStudy::Row* cheapest_untold(const Levels& levels) {
  std::vector<PartsStudy::Row> rows = levels.measured();
  std::stable_sort(rows.begin(), rows.end(), [&](const PartsStudy::Row& a, const PartsStudy::Row& b) {
    return levels.error(a) < levels.error(b);
  });
  std::string name;
  double least = std::numeric_limits<double>::infinity();
  for (const PartsStudy::Row& row : rows) {
    // A level that happens to answer alike while better ones do not is no better than these.
    if (!(levels.distance(row) <= kTold)) break;
    if (levels.step_time(row) >= least) continue;
    least = levels.step_time(row);
    name = row.case_name;
  }
  const auto found = std::find_if(levels.measured().begin(), levels.measured().end(),
                                  [&](const PartsStudy::Row& row) { return row.case_name == name; });
  return found == levels.measured().end() ? nullptr : &*found;
}

std::string conclusion(const Levels& levels) {
  const PartsStudy::Row* const cheapest = cheapest_untold(levels);
  if (!cheapest) return "The figures of the finest level or of chance are missing: nothing can be said yet.";
  const PartsStudy::Row& finest = levels.finest();
  if (cheapest->case_name == finest.case_name)
    return "Every cheaper level can be told from the finest one (" + finest.level + ") by one bed.";
  return "The cheapest level that one bed does not tell from the finest (" + finest.level +
         "), nor any level of less error, is **" + cheapest->level + "**, error " +
         fixed(100 * levels.error(*cheapest), 1) + " %: a step of it takes " +
         fixed(levels.step_time(*cheapest) / levels.step_time(finest), 2) + " of the time.";
}

}  // namespace

std::string mean_of(const std::string& answer) { return "mean of " + answer; }
std::string deviation_of(const std::string& answer) { return "standard deviation of " + answer; }

std::string parts_page(const std::vector<ReportedFigure>& figures, const std::vector<PartsStudy>& studies) {
  const BedSize size;
  std::string page =
      "# How many parts does a rock need?\n\nWritten by `talus bench parts` on " + today() + ", one thread of " +
      processor_name() + ".\n\nThe same " + std::to_string(size.rocks) +
      " rocks at every level of detail, in the same places and attitudes: poured into a box of " +
      fixed(size.length, 0) + " x " + fixed(size.width, 0) + " diameters, the box tilted until they slide (" +
      fixed(kSlip, 1) + " diameters on the mean) and, from the bed at rest, emptied through " +
      fixed(100 * kOutlet, 0) + " % of its floor. Friction " + fixed(kBedFriction, 1) + ", restitution " +
      fixed(kBedRestitution, 1) + ", default law, " + std::to_string(kBedSteps) +
      " steps in the stiffest contact. The packing fraction is over the floor and twice the height of the "
      "common centre. The error is the symmetric difference of level and scan over the scan's volume.\n";
  const FigureTable table(figures);
  for (const PartsStudy& study : studies) {
    const Levels levels(table, study);
    if (levels.measured().empty()) continue;
    page += "\n## " + study.shape + "\n\n" + level_table(levels) +
            "\nChance: eight beds of other places and attitudes at the cheapest level. \"Off the finest\" is the "
            "largest difference of an answer from that of the level of least error, in standard deviations of one bed; "
            "up to " +
            fixed(kTold, 0) + " says nothing about the levels.\n\n" + spread_table(levels) + "\n" + conclusion(levels) +
            "\n";
  }
  return page;
}

}  // namespace workflows
