// SPDX-License-Identifier: Apache-2.0
#include "postprocess/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace postprocess {
namespace {

constexpr std::array<const char*, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                              "#e69f00", "#56b4e9", "#555555"};
constexpr const char* kFont = "font-family=\"system-ui, 'Segoe UI', 'DejaVu Sans', sans-serif\"";
constexpr double kLetterWidth = 6.6;  // of 12 px sans-serif, mean [px]

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool is_empty() const { return low > high; }
};

std::string format(const char* pattern, auto... values) {
  char text[512];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string text_at(double x, double y, const std::string& attributes, const std::string& content) {
  return format("<text x=\"%.1f\" y=\"%.1f\" ", x, y) + attributes + ">" + escaped(content) + "</text>\n";
}

std::string line_between(double x1, double y1, double x2, double y2, const char* style) {
  return format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>\n", x1, y1, x2, y2, style);
}

std::string svg_open(int width, int height, const std::string& title) {
  return format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\" "
             "font-size=\"12\" role=\"img\" ",
             width, height, width, height) +
         kFont + " aria-label=\"" + escaped(title) + "\">\n" +
         format("<rect width=\"%d\" height=\"%d\" fill=\"#ffffff\"/>\n", width, height) +
         text_at(14, 20, "font-size=\"14\" font-weight=\"600\" fill=\"#222\"", title);
}

/// The y axis starts at zero where the data come near it; a flat line gets some room.
Range padded(Range range) {
  if (range.is_empty()) return {0, 1};
  const double span = range.high - range.low;
  if (range.low > 0 && range.low < 0.5 * range.high) range.low = 0;
  if (range.high < 0 && range.high > 0.5 * range.low) range.high = 0;
  if (span <= 1e-12 * std::max(std::abs(range.low), std::abs(range.high)) || span == 0) {
    const double room = range.high == 0 ? 1 : 0.1 * std::abs(range.high);
    range.low -= room;
    range.high += room;
  }
  return range;
}

/// Where the plot's numbers land on the page.
struct Frame {
  double left, top, right, bottom;  // [px]
  Range x, y;
  double px(double value) const { return left + (value - x.low) / (x.high - x.low) * (right - left); }
  double py(double value) const { return bottom - (value - y.low) / (y.high - y.low) * (bottom - top); }
};

/// Points of one pixel column are reduced to entry, lowest, highest and exit: the drawn line is the same.
std::vector<std::pair<double, double>> reduced_to_pixels(const Frame& frame, const Curve& curve, std::size_t begin,
                                                         std::size_t end) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = begin; i < end;) {
    const long column = std::lround(2 * frame.px(curve.x[i]));
    std::size_t last = i, low = i, high = i;
    for (std::size_t j = i; j < end && std::lround(2 * frame.px(curve.x[j])) == column; ++j) {
      last = j;
      if (curve.y[j] < curve.y[low]) low = j;
      if (curve.y[j] > curve.y[high]) high = j;
    }
    std::array<std::size_t, 4> kept{i, std::min(low, high), std::max(low, high), last};
    for (std::size_t k = 0; k < kept.size(); ++k)
      if (k == 0 || kept[k] != kept[k - 1]) points.emplace_back(frame.px(curve.x[kept[k]]), frame.py(curve.y[kept[k]]));
    i = last + 1;
  }
  return points;
}

std::string drawn_curve(const Frame& frame, const Curve& curve, const char* colour) {
  std::string lines;
  const std::size_t count = std::min(curve.x.size(), curve.y.size());
  const auto is_drawable = [&](std::size_t i) { return std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]); };
  for (std::size_t begin = 0; begin < count; ++begin) {
    if (!is_drawable(begin)) continue;
    std::size_t end = begin;
    while (end < count && is_drawable(end)) ++end;
    lines += format("<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"1.8\" stroke-linejoin=\"round\"%s points=\"",
                    colour, curve.is_dashed ? " stroke-dasharray=\"6 4\"" : "");
    for (const auto& [x, y] : reduced_to_pixels(frame, curve, begin, end)) lines += format("%.1f,%.1f ", x, y);
    lines.back() = '"';
    lines += "/>\n";
    begin = end;
  }
  return lines;
}

std::string drawn_axes(const Frame& frame, const LinePlot& plot) {
  std::string axes;
  for (const double tick : axis_ticks(frame.y.low, frame.y.high, 5)) {
    axes += line_between(frame.left, frame.py(tick), frame.right, frame.py(tick), "stroke=\"#e4e4e4\"");
    axes += text_at(frame.left - 7, frame.py(tick) + 4, "text-anchor=\"end\" fill=\"#444\"", short_number(tick));
  }
  for (const double tick : axis_ticks(frame.x.low, frame.x.high, 8)) {
    axes += line_between(frame.px(tick), frame.bottom, frame.px(tick), frame.bottom + 5, "stroke=\"#777\"");
    axes += text_at(frame.px(tick), frame.bottom + 19, "text-anchor=\"middle\" fill=\"#444\"", short_number(tick));
  }
  if (frame.y.low < 0 && frame.y.high > 0)
    axes += line_between(frame.left, frame.py(0), frame.right, frame.py(0), "stroke=\"#aaa\"");
  axes += line_between(frame.left, frame.bottom, frame.right, frame.bottom, "stroke=\"#777\"");
  axes += line_between(frame.left, frame.top, frame.left, frame.bottom, "stroke=\"#777\"");
  axes +=
      text_at((frame.left + frame.right) / 2, frame.bottom + 38, "text-anchor=\"middle\" fill=\"#222\"", plot.x_label);
  const double middle = (frame.top + frame.bottom) / 2;
  axes += text_at(16, middle, format("text-anchor=\"middle\" fill=\"#222\" transform=\"rotate(-90 16 %.1f)\"", middle),
                  plot.y_label);
  return axes;
}

/// A curve without a label belongs to the one before it.
const char* colour_of(const LinePlot& plot, std::size_t curve) {
  std::size_t labelled = 0;
  for (std::size_t c = 1; c <= curve; ++c) labelled += plot.curves[c].label.empty() ? 0 : 1;
  return kColours[labelled % kColours.size()];
}

/// Entries side by side under the title, wrapped to the plot's width; returns the rows used.
int drawn_legend(const LinePlot& plot, double left, std::string& legend) {
  double x = left;
  int row = 0;
  bool is_any = false;
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const Curve& curve = plot.curves[c];
    if (curve.label.empty()) continue;
    const double width = 34 + kLetterWidth * static_cast<double>(curve.label.size());
    if (x + width > plot.width - 10 && x > left) {
      x = left;
      ++row;
    }
    const double y = 40 + 17.0 * row;
    legend +=
        format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"2.5\"%s/>\n", x,
               y - 4, x + 20, y - 4, kColours[c % kColours.size()], curve.is_dashed ? " stroke-dasharray=\"6 4\"" : "");
    legend += text_at(x + 25, y, "fill=\"#333\"", curve.label);
    x += width;
    is_any = true;
  }
  return is_any ? row + 1 : 0;
}

}  // namespace

std::vector<double> axis_ticks(double low, double high, int count) {
  std::vector<double> ticks;
  if (!(high > low) || count < 1) return ticks;
  const double raw = (high - low) / count;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  const double share = raw / power;
  const double step = power * (share <= 1 ? 1 : share <= 2 ? 2 : share <= 5 ? 5 : 10);
  const double slack = 1e-9;  // a tick on the edge must not fall to rounding [steps]
  for (double k = std::ceil(low / step - slack); k <= std::floor(high / step + slack); ++k)
    ticks.push_back(k == 0 ? 0.0 : k * step);
  return ticks;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        // XML 1.0 has no place for control characters.
        out += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? ' ' : c;
    }
  }
  return out;
}

std::string short_number(double value, int digits) {
  if (!std::isfinite(value)) return std::isnan(value) ? "not a number" : value > 0 ? "infinite" : "-infinite";
  const double magnitude = std::abs(value);
  if (magnitude >= 1e-4 && magnitude < 1e6) {
    const int before_point = magnitude < 1 ? 1 : static_cast<int>(std::floor(std::log10(magnitude))) + 1;
    const int leading_zeros = magnitude < 1 ? static_cast<int>(-std::floor(std::log10(magnitude))) - 1 : 0;
    const int decimals = std::max(0, magnitude < 1 ? digits + leading_zeros : digits - before_point);
    std::string text = format("%.*f", decimals, value);
    if (text.find('.') != std::string::npos) {
      text.erase(text.find_last_not_of('0') + 1);
      if (text.back() == '.') text.pop_back();
    }
    return text;
  }
  return format("%.*g", digits, value);
}

std::string svg(const LinePlot& plot) {
  std::string legend;
  const int legend_rows = drawn_legend(plot, 70, legend);
  Frame frame{70, 34 + 17.0 * legend_rows, plot.width - 18.0, plot.height - 48.0, {}, {}};
  for (const Curve& curve : plot.curves) {
    for (const double x : curve.x) frame.x.include(x);
    for (const double y : curve.y) frame.y.include(y);
  }
  if (frame.x.is_empty()) frame.x = {0, 1};
  if (frame.x.high <= frame.x.low) frame.x.high = frame.x.low + 1;
  frame.y = plot.y_range ? Range{plot.y_range->first, plot.y_range->second} : padded(frame.y);
  std::string page = svg_open(plot.width, plot.height, plot.title) + legend + drawn_axes(frame, plot);
  for (std::size_t c = 0; c < plot.curves.size(); ++c) page += drawn_curve(frame, plot.curves[c], colour_of(plot, c));
  return page + "</svg>\n";
}

std::string svg(const BarPlot& plot) {
  constexpr double bar_height = 22, top = 58;
  std::size_t longest = 0;
  Range range{0, 0};
  for (const BarPlot::Bar& bar : plot.bars) {
    longest = std::max(longest, bar.label.size());
    range.include(bar.first + bar.second);
  }
  if (range.high <= 0) range.high = 1;
  const double left = std::min(0.45 * plot.width, 22 + kLetterWidth * static_cast<double>(longest));
  const double right = plot.width - 70.0, bottom = top + bar_height * static_cast<double>(plot.bars.size());
  const auto px = [&](double value) { return left + value / range.high * (right - left); };

  std::string page = svg_open(plot.width, static_cast<int>(bottom) + 50, plot.title);
  double legend_x = left;
  for (const auto& [label, colour] :
       {std::pair{plot.first_label, kColours[0]}, std::pair{plot.second_label, kColours[4]}}) {
    page += format("<rect x=\"%.1f\" y=\"32\" width=\"12\" height=\"12\" fill=\"%s\"/>\n", legend_x, colour);
    page += text_at(legend_x + 18, 42, "fill=\"#333\"", label);
    legend_x += 44 + kLetterWidth * static_cast<double>(label.size());
  }
  for (const double tick : axis_ticks(0, range.high, 6)) {
    page += line_between(px(tick), top, px(tick), bottom, "stroke=\"#e4e4e4\"");
    page += text_at(px(tick), bottom + 16, "text-anchor=\"middle\" fill=\"#444\"", short_number(tick));
  }
  for (std::size_t b = 0; b < plot.bars.size(); ++b) {
    const BarPlot::Bar& bar = plot.bars[b];
    const double y = top + bar_height * static_cast<double>(b);
    const auto rectangle = [&](double from, double to, const char* colour) {
      return format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", px(from), y + 3,
                    std::max(0.0, px(to) - px(from)), bar_height - 6, colour);
    };
    page += text_at(left - 8, y + 15, "text-anchor=\"end\" fill=\"#222\"", bar.label);
    page += rectangle(0, bar.first, kColours[0]) + rectangle(bar.first, bar.first + bar.second, kColours[4]);
    page += text_at(px(bar.first + bar.second) + 6, y + 15, "fill=\"#444\"", short_number(bar.first + bar.second, 3));
  }
  page += text_at((left + right) / 2, bottom + 36, "text-anchor=\"middle\" fill=\"#222\"", plot.value_label);
  return page + "</svg>\n";
}

}  // namespace postprocess
