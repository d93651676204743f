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

struct LogRange {
  double low = INFINITY, high = -INFINITY;  // powers of ten

  void cover(double value) {
    low = std::min(low, std::floor(std::log10(value)));
    high = std::max(high, std::ceil(std::log10(value)));
  }
  double share(double value) const { return (std::log10(value) - low) / (high - low); }
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

bool is_drawn(double x, double y) { return std::isfinite(x) && std::isfinite(y) && x > 0 && y > 0; }

struct Canvas {
  LogRange x, y;

  double across(double value) const { return kLeft + kPlotWidth * x.share(value); }
  double down(double value) const { return kTop + kPlotHeight * (1 - y.share(value)); }

  std::string grid() const {
    std::string svg;
    const auto rule = [&](double x1, double y1, double x2, double y2) {
      svg += format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>\n", x1, y1, x2, y2);
    };
    // At most about eight labels an axis.
    const auto spacing = [](const LogRange& range) { return std::max(1.0, std::ceil((range.high - range.low) / 8)); };
    for (double power = x.low; power <= x.high; power += spacing(x)) {
      const double at = across(std::pow(10, power));
      rule(at, kTop, at, kTop + kPlotHeight);
      svg += text_at(at, kTop + kPlotHeight + kLine, "middle", format("1e%.0f", power));
    }
    for (double power = y.low; power <= y.high; power += spacing(y)) {
      const double at = down(std::pow(10, power));
      rule(kLeft, at, kLeft + kPlotWidth, at);
      svg += text_at(kLeft - 6, at + 4, "end", format("1e%.0f", power));
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
    return "<polyline fill=\"none\" stroke-width=\"1.5\" stroke=\"" + std::string(colour) + "\" points=\"" + points +
           "\"/>\n" + dots;
  }
};

Canvas canvas_for(const std::vector<const PlotCurve*>& curves) {
  Canvas canvas;
  for (const PlotCurve* curve : curves)
    for (std::size_t i = 0; i < curve->x.size(); ++i)
      if (is_drawn(curve->x[i], curve->y[i])) canvas.x.cover(curve->x[i]), canvas.y.cover(curve->y[i]);
  for (LogRange* range : {&canvas.x, &canvas.y}) {
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

  const Canvas canvas = canvas_for(curves);
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
