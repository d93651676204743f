// SPDX-License-Identifier: Apache-2.0
#include "postprocess/run_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "postprocess/contact_statistics.h"
#include "postprocess/report/base64.h"
#include "postprocess/report/embedded.h"
#include "postprocess/report/page_parts.h"
#include "postprocess/report/viewer_scene.h"
#include "postprocess/svg_plot.h"

namespace postprocess {
namespace {

constexpr const char* kUnknown = "not recorded";

std::string percent(double share, int digits = 3) { return short_number(100 * share, digits) + " %"; }

std::string optional_number(const std::optional<double>& value, const std::string& unit = "", int digits = 4) {
  return value ? short_number(*value, digits) + (unit.empty() ? "" : " " + unit) : kUnknown;
}

std::string optional_percent(const std::optional<double>& share) { return share ? percent(*share) : "-"; }

std::string with_interval(const IntervalMean& mean, const std::string& unit) {
  std::string text = short_number(mean.mean);
  // Below rounding of the mean there is nothing to tell.
  if (mean.batches > 1 && mean.half_width > 1e-9 * std::abs(mean.mean))
    text += " ± " + short_number(mean.half_width, 2);
  return text + " " + unit;
}

// ---- How far to trust the run

/// One line of the trust table: what was measured, its value, the bound asked for, the verdict.
struct TrustLine {
  std::string what, value, goal, verdict, style;
};

std::string trust_row(const TrustLine& line) {
  return "<tr><td>" + escaped(line.what) + "</td><td class=\"number\">" + escaped(line.value) + "</td><td>" +
         escaped(line.goal) + "</td><td class=\"verdict " + line.style + "\">" + escaped(line.verdict) + "</td></tr>\n";
}

TrustLine energy_line(const RunFigures& figures) {
  const std::string what = "Energy balance: energy unaccounted for / energy put in";
  const std::string goal = "at most " + percent(kEnergyGoal);
  if (!figures.imbalance_share) return {what, kUnknown, goal, "cannot be judged", "open"};
  const bool is_met = figures.energy_balance_closes();
  return {what,
          percent(*figures.imbalance_share) + " (" + short_number(*figures.imbalance, 3) + " J of " +
              short_number(*figures.throughput, 4) + " J)",
          goal, is_met ? "closes" : "does not close", is_met ? "met" : "missed"};
}

/// Largest difference in passing between the distribution asked for and the one the bodies have, at the sizes of the
/// former.
std::optional<double> size_distribution_error(const RunSummary::SizeDistribution& sizes) {
  if (sizes.requested.empty() || sizes.realised.empty()) return std::nullopt;
  std::vector<double> size, passing;
  for (const auto& [s, p] : sizes.realised) {
    size.push_back(s);
    passing.push_back(p);
  }
  double worst = 0;
  for (const auto& [s, p] : sizes.requested) worst = std::max(worst, std::abs(interpolated(size, passing, s) - p));
  return worst;
}

std::string shape_error_table(const std::vector<RunSummary::ShapeError>& shapes) {
  if (shapes.empty()) return "";
  Table table({"shape", "parts", "vertices", "faces", "volume [m³]", "surface moved: symmetric difference / volume",
               "volume error"},
              1);
  for (const RunSummary::ShapeError& shape : shapes)
    table.add({shape.name, optional_number(shape.parts), optional_number(shape.vertices), optional_number(shape.faces),
               optional_number(shape.volume), optional_percent(shape.symmetric_difference),
               optional_percent(shape.volume_error)});
  return "<h3>What the shapes lost against their scans</h3>\n" + table.html();
}

std::string trust_section(const RunFolder& run, const RunFigures& figures) {
  std::vector<TrustLine> lines{energy_line(figures)};
  const auto plain = [&](const std::string& what, const std::optional<double>& value, const std::string& text) {
    if (value)
      lines.push_back({what, text, "no bound set", "reported", "open"});
    else
      lines.push_back({what, kUnknown, "no bound set", "cannot be judged", "open"});
  };
  plain("Largest overlap met / equivalent diameter of the smaller body", figures.largest_overlap,
        optional_percent(figures.largest_overlap));
  plain("Fewest time steps in a contact, from the stiffness met", figures.smallest_steps_per_contact,
        optional_number(figures.smallest_steps_per_contact, "", 3));
  if (figures.mill && !figures.mill->accounts.times.empty() && figures.mill->torque_power.mean != 0) {
    const double gap = std::abs(figures.mill->ledger_power.mean / figures.mill->torque_power.mean - 1);
    plain("Mill power: gap between torque and energy ledger", gap, percent(gap));
  }
  if (run.summary && run.summary->size_distribution) {
    const auto error = size_distribution_error(*run.summary->size_distribution);
    plain("Size distribution: largest gap in passing between asked for and realised", error, optional_percent(error));
  }
  std::string rows = "<table>\n<tr><th>check</th><th class=\"number\">value</th><th>bound</th><th>verdict</th></tr>\n";
  for (const TrustLine& line : lines) rows += trust_row(line);
  std::string body = rows + "</table>\n";
  if (run.summary) body += shape_error_table(run.summary->shapes);
  if (run.summary)
    for (const std::string& warning : run.summary->warnings)
      body += "<div class=\"warning\">Warning of the run: " + escaped(warning) + "</div>\n";
  return section("How far to trust this run", body);
}

// ---- Results in numbers

std::string figure_box(const std::string& value, const std::string& meaning) {
  return "<div class=\"figure\"><b>" + escaped(value) + "</b><span>" + escaped(meaning) + "</span></div>\n";
}

std::string mill_boxes(const MillFigures& mill) {
  const std::string window =
      mill.window.revolutions > 0
          ? "mean of the last " + (mill.window.revolutions == 1
                                       ? std::string("whole revolution")
                                       : std::to_string(mill.window.revolutions) + " whole revolutions")
          : "mean from " + short_number(mill.window.from_time) + " s to " + short_number(mill.window.to_time) + " s";
  std::string boxes = figure_box(with_interval(mill.torque_power, "W"), "power from torque, " + window);
  if (!mill.accounts.times.empty())
    boxes += figure_box(with_interval(mill.ledger_power, "W"), "power from the energy ledger, same time");
  return boxes + figure_box(short_number(std::abs(mill.angular_speed) * 30 / std::numbers::pi, 3) + " rpm",
                            "drum speed, from torque and power");
}

std::string results_section(const RunFigures& figures) {
  std::string boxes;
  if (figures.mill) boxes += mill_boxes(*figures.mill);
  if (figures.discharged) {
    const Discharge& out = *figures.discharged;
    boxes += figure_box(short_number(out.mass) + " kg", "discharged, " + short_number(out.count, 6) + " bodies");
    boxes += figure_box(with_interval(out.rate, "kg/s"), "discharge rate between 10 % and 80 % of the mass");
    boxes += figure_box(short_number(out.first_time) + " s", "first body left");
  }
  if (boxes.empty()) return "";
  return section("Results", "<div class=\"figures\">\n" + boxes + "</div>\n" +
                                paragraph("± is the half width of a 95 % confidence interval by batch means: it holds "
                                          "fluctuation within this run, not the error of the model.",
                                          "note"));
}

// ---- Pictures, view, curves

std::string picture_section(const ReportContents& contents) {
  if (contents.pictures.empty())
    return section("Pictures", paragraph("No pictures: " + contents.no_pictures_because + ".", "note"));
  std::string body = "<div class=\"pictures\">\n";
  for (const ReportContents::Picture& picture : contents.pictures) {
    const std::string caption = "t = " + short_number(picture.time) + " s, coloured by speed";
    body += figure(picture.png, caption);
  }
  return section("Pictures", body + "</div>\n");
}

std::string viewer_section(const RunFolder& run, const ReportContents& contents) {
  if (contents.frames.empty()) return "";
  return section("Look around",
                 "<canvas id=\"viewer\"></canvas>\n<div id=\"viewer-controls\"><button id=\"viewer-play\">play</button>"
                 "<input id=\"viewer-slider\" type=\"range\" min=\"0\" step=\"1\" aria-label=\"snapshot\"/>"
                 "<span id=\"viewer-time\"></span></div>\n"
                 "<p class=\"note\" id=\"viewer-note\">Drag to turn, shift-drag to move, wheel to zoom, double click "
                 "to reset.</p>\n"
                 "<script type=\"application/json\" id=\"viewer-scene\">" +
                     viewer_scene_json(run.geometry, contents.frames, contents.view, run.up) + "</script>\n<script>\n" +
                     kViewerScript + "</script>\n");
}

std::string plot_section(const std::vector<NamedPlot>& plots) {
  if (plots.empty()) return "";
  std::string body = "<div class=\"plots\">\n";
  for (const NamedPlot& plot : plots) body += "<div id=\"plot-" + plot.name + "\">" + plot.svg + "</div>\n";
  return section("Curves", body + "</div>\n");
}

std::string contact_section(const RunFolder& run, const std::vector<dem_gpu::Snapshot>& frames) {
  if (frames.empty()) return "";
  std::vector<std::size_t> shown{0, frames.size() / 2, frames.size() - 1};
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  std::vector<ContactStatistics> statistics;
  std::vector<std::string> headings{"at time"};
  for (const std::size_t f : shown) {
    statistics.push_back(contact_statistics(run.geometry, frames[f]));
    headings.push_back(short_number(frames[f].time) + " s");
  }
  Table table(headings, 1);
  const auto add = [&](const char* what, auto value) {
    std::vector<std::string> cells{what};
    for (const ContactStatistics& s : statistics) cells.push_back(value(s));
    table.add(cells);
  };
  using Statistics = const ContactStatistics&;
  add("bodies", [](Statistics s) { return std::to_string(s.active_bodies); });
  add("contacts between bodies", [](Statistics s) { return std::to_string(s.body_contacts); });
  add("contacts with walls", [](Statistics s) { return std::to_string(s.wall_contacts); });
  add("neighbours touched, mean of a body", [](Statistics s) { return short_number(s.coordination_number, 3); });
  add("bodies touching nothing", [](Statistics s) { return std::to_string(s.touching_nothing); });
  add("force, mean [N]", [](Statistics s) { return short_number(s.force.mean, 3); });
  add("force, median [N]", [](Statistics s) { return short_number(s.force.median, 3); });
  add("force, 90th / 99th percentile [N]", [](Statistics s) {
    return short_number(s.force.percentile_90, 3) + " / " + short_number(s.force.percentile_99, 3);
  });
  add("force, largest [N]", [](Statistics s) { return short_number(s.force.largest, 3); });
  add("overlap, median", [](Statistics s) { return percent(s.overlap.median, 2); });
  add("overlap, 99th percentile", [](Statistics s) { return percent(s.overlap.percentile_99, 2); });
  add("overlap, largest", [](Statistics s) { return percent(s.overlap.largest, 2); });
  return section("Contacts", table.html() + paragraph("Force is the magnitude of normal force and friction together; "
                                                      "overlap is depth over the equivalent diameter of the smaller "
                                                      "body.",
                                                      "note"));
}

// ---- Scene and how to make it again

std::string scene_line(const RunFolder& run) {
  const auto parts = [&] {
    std::size_t total = 0;
    for (const int shape : run.geometry.body_shape)
      total += std::max<std::size_t>(1, run.geometry.shapes[shape].parts.size());
    return total;
  }();
  std::string line = std::to_string(run.geometry.body_shape.size()) + " bodies (" + std::to_string(parts) +
                     " convex parts and spheres) of " + std::to_string(run.geometry.shapes.size()) + " shapes, " +
                     std::to_string(run.geometry.walls.size()) + " walls";
  if (run.summary && run.summary->simulated_time)
    line += ", " + short_number(*run.summary->simulated_time) + " s simulated";
  if (run.summary && run.summary->steps) line += " in " + short_number(*run.summary->steps, 10) + " steps";
  return line;
}

std::string scene_section(const RunFolder& run) {
  const dem_gpu::RunGeometry& geometry = run.geometry;
  struct Population {
    int count = 0;
    double mass = 0, smallest = 1e300, largest = 0;
  };
  std::map<std::pair<int, int>, Population> populations;
  for (std::size_t b = 0; b < geometry.body_shape.size(); ++b) {
    Population& p = populations[{geometry.body_shape[b], geometry.body_material[b]}];
    const double diameter = equivalent_diameter(geometry, static_cast<int>(b));
    ++p.count;
    p.mass += geometry.body_mass[b];
    p.smallest = std::min(p.smallest, diameter);
    p.largest = std::max(p.largest, diameter);
  }
  Table bodies({"shape", "material", "parts", "bodies", "mass [kg]", "equivalent diameter [mm]"}, 2);
  for (const auto& [key, p] : populations) {
    const dem_gpu::ShapeGeometry& shape = geometry.shapes[key.first];
    bodies.add({shape.name,
                geometry.materials[key.second] + ", " + short_number(geometry.material_density[key.second]) + " kg/m³",
                shape.sphere_radius > 0 ? "sphere" : std::to_string(shape.parts.size()), std::to_string(p.count),
                short_number(p.mass), short_number(1000 * p.smallest, 3) + " - " + short_number(1000 * p.largest, 3)});
  }
  constexpr const char* kKindNames[] = {"plane", "disc", "cylinder", "cone", "volume object"};
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> walls;
  for (const dem_gpu::WallGeometry& wall : geometry.walls)
    walls[{wall.contact_class, kKindNames[static_cast<int>(wall.kind)]}].push_back(wall.name);
  Table wall_table({"contact class", "kind", "walls", "names"});
  for (const auto& [key, names] : walls) {
    std::string list;
    for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 6); ++i) list += (i ? ", " : "") + names[i];
    wall_table.add({key.first, key.second, std::to_string(names.size()), names.size() > 6 ? list + " …" : list});
  }
  std::string body = "<h3>Bodies</h3>\n" + bodies.html();
  if (!walls.empty()) body += "<h3>Walls</h3>\n" + wall_table.html();
  if (run.summary && run.summary->size_distribution) {
    const auto& sizes = *run.summary->size_distribution;
    const auto millimetres = [](const std::optional<double>& d) {
      return d ? short_number(1000 * *d, 3) + " mm" : std::string("-");
    };
    body += paragraph("Sizes realised (" + sizes.definition + ", by " + sizes.basis + "): d10 " +
                      millimetres(sizes.d10) + ", d50 " + millimetres(sizes.d50) + ", d80 " + millimetres(sizes.d80) +
                      ", d90 " + millimetres(sizes.d90) + ".");
  }
  return section("Scene", body);
}

std::string again_section(const RunFolder& run) {
  if (!run.summary) return "";
  const RunSummary& s = *run.summary;
  std::string body;
  if (!s.command.empty()) body += "<pre>" + escaped(s.command) + "</pre>\n";
  Table table({"what", "value"});
  const auto add = [&](const char* what, const std::string& value) {
    if (!value.empty()) table.add({what, value});
  };
  add("run made by", s.tool_version);
  add("report made by", std::string("talus ") + TALUS_VERSION);
  add("back end, precision", s.backend + (s.precision.empty() ? "" : ", " + s.precision));
  add("time step", optional_number(s.time_step, "s"));
  add("wall time", optional_number(s.wall_seconds, "s"));
  if (s.steps && s.wall_seconds && *s.wall_seconds > 0)
    add("bodies × steps / wall second",
        short_number(static_cast<double>(run.geometry.body_shape.size()) * *s.steps / *s.wall_seconds, 3));
  std::string passes;
  for (const std::string& pass : s.passes) passes += (passes.empty() ? "" : ", ") + pass;
  add("passes of a step", passes);
  return section("Make it again", body + table.html());
}

}  // namespace

std::vector<std::size_t> viewer_frames(std::size_t count, std::size_t bodies) {
  std::vector<std::size_t> frames;
  const std::size_t wanted = std::min(count, viewer_frame_limit(bodies));
  for (std::size_t k = 0; k < wanted; ++k) frames.push_back(wanted == 1 ? count - 1 : k * (count - 1) / (wanted - 1));
  return frames;
}

std::string run_report_html(const RunFolder& run, const RunFigures& figures, const ReportContents& contents) {
  std::string page = page_head(run.name() + " - Talus run") + "<h1>" + escaped(run.name()) + "</h1>\n" +
                     paragraph(scene_line(run), "lead");
  if (!run.summary)
    page +=
        "<div class=\"warning\">The run has no run.json: it has not ended, or was stopped. The figures below hold "
        "up to its last table row.</div>\n";
  else if (!run.summary->is_finished)
    page +=
        "<div class=\"warning\">The run was stopped before its end time; talus simulate --resume goes on from its "
        "last checkpoint.</div>\n";
  page += trust_section(run, figures);
  page += results_section(figures);
  page += picture_section(contents);
  page += viewer_section(run, contents);
  page += plot_section(contents.plots);
  page += contact_section(run, contents.frames);
  page += scene_section(run);
  page += again_section(run);
  return page + kPageEnd;
}

}  // namespace postprocess
