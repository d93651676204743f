// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace postprocess {

/// One line of a plot; a value that is not finite breaks the line. x and y have equal sizes.
struct Curve {
  std::string label;  // for the legend; empty: not in it, and the colour of the curve before
  std::vector<double> x;
  std::vector<double> y;
  bool is_dashed = false;
};

/// Line plot. Colours follow the order of the curves (Okabe & Ito 2008, told apart by colour-blind readers too).
struct LinePlot {
  std::string title;
  std::string x_label;  // with its unit: "time [s]"
  std::string y_label;
  std::vector<Curve> curves;
  std::optional<std::pair<double, double>> y_range;  // else from the curves, zero included where it is near
  int width = 640;                                   // [px]
  int height = 320;                                  // [px]
};

/// Horizontal bars of two shares on top of one another: `first` and `second` of each label, none negative.
struct BarPlot {
  std::string title;
  std::string value_label;  // with its unit
  std::string first_label;
  std::string second_label;
  struct Bar {
    std::string label;
    double first = 0;
    double second = 0;
  };
  std::vector<Bar> bars;
  int width = 640;  // [px]
};

/// One <svg> element, complete in itself: a file, or part of a page.
std::string svg(const LinePlot& plot);
std::string svg(const BarPlot& plot);

/// Round numbers that cover [low, high] at 1, 2 or 5 times a power of ten apart, about `count` of them.
std::vector<double> axis_ticks(double low, double high, int count);

/// Text with & < > " ' replaced, for HTML and SVG.
std::string escaped(const std::string& text);

/// Up to `digits` significant digits, without trailing zeros: 0.05, 1.2e-06, 48200.
std::string short_number(double value, int digits = 4);

}  // namespace postprocess
