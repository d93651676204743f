// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/log_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace workflows {
namespace {

// Layout [px].
constexpr double kLeft = 70, kTop = 40, kPlotWidth = 480, kPlotHeight = 340, kLegendWidth = 230, kLine = 16;
/// Curves told apart by colour-blind readers too: Okabe & Ito (2008).
constexpr std::array<const char*, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                              "#e69f00", "#56b4e9", "#000000"};

struct AxisRange {
  bool is_linear = false;
  double low = INFINITY, high = -INFINITY;  // powers of ten, or values

  void cover(double value) {
    low = std::min(low, is_linear ? value : std::floor(std::log10(value)));
    high = std::max(high, is_linear ? value : std::ceil(std::log10(value)));
  }
  double share(double value) const { return ((is_linear ? value : std::log10(value)) - low) / (high - low); }

  /// Few powers of ten are divided at 2 and 5.
  bool is_divided() const { return !is_linear && high - low <= 3; }

  /// Values to label, at most about ten; linear ones are 1, 2 or 5 times a power of ten apart.
  std::vector<double> ticks() const {
    std::vector<double> values;
    if (!is_linear) {
      for (double power = low; power <= high; power += std::max(1.0, std::ceil((high - low) / 8))) {
        values.push_back(std::pow(10, power));
        if (is_divided() && power < high) values.insert(values.end(), {2 * values.back(), 5 * values.back()});
      }
      return values;
    }
    const double decade = std::pow(10, std::floor(std::log10((high - low) / 8)));
    double spacing = decade;
    for (const double factor : {2.0, 5.0, 10.0})
      if ((high - low) / spacing > 8) spacing = factor * decade;
    for (double i = std::ceil(low / spacing); i * spacing <= high; ++i) values.push_back(i * spacing);
    return values;
  }
};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '&')
      result += "&amp;";
    else if (letter == '<')
      result += "&lt;";
    else if (letter == '>')
      result += "&gt;";
    else
      result += letter;
  }
  return result;
}

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor) + escaped(text) + "</text>\n";
}

struct Canvas {
  AxisRange x, y;

  bool is_drawn(double at_x, double at_y) const {
    return std::isfinite(at_x) && std::isfinite(at_y) && (x.is_linear || (at_x > 0 && at_y > 0));
  }

  double across(double value) const { return kLeft + kPlotWidth * x.share(value); }
  double down(double value) const { return kTop + kPlotHeight * (1 - y.share(value)); }

  std::string grid() const {
    std::string svg;
    const auto rule = [&](double x1, double y1, double x2, double y2) {
      svg += format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>\n", x1, y1, x2, y2);
    };
    const auto label = [](const AxisRange& range, double value) {
      return range.is_linear || range.is_divided() ? format("%.3g", value) : format("1e%.0f", std::log10(value));
    };
    for (const double value : x.ticks()) {
      const double at = across(value);
      rule(at, kTop, at, kTop + kPlotHeight);
      svg += text_at(at, kTop + kPlotHeight + kLine, "middle", label(x, value));
    }
    for (const double value : y.ticks()) {
      const double at = down(value);
      rule(kLeft, at, kLeft + kPlotWidth, at);
      svg += text_at(kLeft - 6, at + 4, "end", label(y, value));
    }
    return svg;
  }

  std::string line(const PlotCurve& curve, const char* colour) const {
    std::string points, dots;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!is_drawn(curve.x[i], curve.y[i])) continue;
      const double px = across(curve.x[i]), py = down(curve.y[i]);
      points += format("%.1f,%.1f ", px, py);
      dots += format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>\n", px, py, colour);
    }
    if (curve.is_reference) return dots;
    return "<polyline fill=\"none\" stroke-width=\"1.5\" stroke=\"" + std::string(colour) + "\" points=\"" + points +
           "\"/>\n" + dots;
  }
};

Canvas canvas_for(const std::vector<const PlotCurve*>& curves, bool is_linear) {
  Canvas canvas;
  canvas.x.is_linear = canvas.y.is_linear = is_linear;
  for (const PlotCurve* curve : curves)
    for (std::size_t i = 0; i < curve->x.size(); ++i)
      if (canvas.is_drawn(curve->x[i], curve->y[i])) canvas.x.cover(curve->x[i]), canvas.y.cover(curve->y[i]);
  for (AxisRange* range : {&canvas.x, &canvas.y}) {
    if (!(range->low <= range->high)) *range = {0, 1};
    if (range->low == range->high) range->high += 1;
  }
  return canvas;
}

std::vector<std::string> failed_points(const std::vector<const PlotCurve*>& curves) {
  std::vector<std::string> names;
  for (const PlotCurve* curve : curves)
    for (std::size_t i = 0; i < curve->x.size(); ++i)
      if (std::isnan(curve->y[i])) names.push_back(curve->label + ", " + curve->point_names[i]);
  return names;
}

}  // namespace

std::string log_plot_svg(const PlotAxes& axes, const std::vector<PlotCurve>& all_curves) {
  std::vector<const PlotCurve*> curves;
  for (const PlotCurve& curve : all_curves)
    if (curve.plot == axes.name) curves.push_back(&curve);
  const std::vector<std::string> failed = failed_points(curves);
  const double width = kLeft + kPlotWidth + kLegendWidth;
  const double height = kTop + kPlotHeight + 60 + kLine * static_cast<double>(failed.size());

  const Canvas canvas = canvas_for(curves, axes.is_linear);
  std::string svg = format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" ", width, height) +
                    format("viewBox=\"0 0 %.0f %.0f\" font-family=\"sans-serif\" font-size=\"12\">\n", width, height) +
                    "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  svg += text_at(kLeft, kTop - 16, "start", axes.title) + canvas.grid();
  svg += text_at(kLeft + kPlotWidth / 2, kTop + kPlotHeight + 2.4 * kLine, "middle", axes.x_label);
  svg += format("<text transform=\"translate(16 %.1f) rotate(-90)\" text-anchor=\"middle\">", kTop + kPlotHeight / 2) +
         escaped(axes.y_label) + "</text>\n";
  double legend = kTop + kLine;
  for (std::size_t i = 0; i < curves.size(); ++i, legend += kLine) {
    const char* colour = kColours[i % kColours.size()];
    svg += canvas.line(*curves[i], colour);
    svg += format("<rect x=\"%.1f\" y=\"%.1f\" width=\"12\" height=\"3\" fill=\"%s\"/>\n", kLeft + kPlotWidth + 12,
                  legend - 5, colour);
    svg += text_at(kLeft + kPlotWidth + 30, legend, "start", curves[i]->label);
  }
  double below = kTop + kPlotHeight + 4 * kLine;
  for (const std::string& name : failed) {
    svg += text_at(kLeft, below, "start", "failed: " + name);
    below += kLine;
  }
  return svg + "</svg>\n";
}

}  // namespace workflows
