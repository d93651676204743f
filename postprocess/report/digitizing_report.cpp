// SPDX-License-Identifier: Apache-2.0
#include "postprocess/digitizing_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalog/grade.h"
#include "postprocess/report/page_parts.h"

namespace postprocess {
namespace {

constexpr int kDigits = 6;  // of a figure

std::string css_colour(const PageColour& colour) {
  return "rgb(" + std::to_string(colour[0]) + "," + std::to_string(colour[1]) + "," + std::to_string(colour[2]) + ")";
}

/// A name in the page's own addresses: letters and digits, the rest as numbers.
std::string anchor(const std::string& name) {
  std::string text = "grain-";
  for (const char letter : name)
    text += std::isalnum(static_cast<unsigned char>(letter)) ? std::string(1, letter)
                                                             : "-" + std::to_string(static_cast<unsigned char>(letter));
  return text;
}

std::string notes_html(const std::vector<std::string>& notes) {
  std::string text;
  for (const std::string& note : notes) text += "<div class=\"warning\">" + escaped(note) + "</div>\n";
  return text;
}

std::string pictures_html(const std::vector<PagePicture>& pictures) {
  if (pictures.empty()) return "";
  std::string text = "<div class=\"pictures\">\n";
  for (const PagePicture& picture : pictures) text += figure(picture.png, picture.caption);
  return text + "</div>\n";
}

std::string table_html(const PageTable& table) {
  Table rows(table.headings, 1);
  for (const auto& row : table.rows) rows.add(row);
  return (table.title.empty() ? "" : "<h3>" + escaped(table.title) + "</h3>\n") + rows.html();
}

std::string grade_html(int grade) {
  constexpr const char* kStyles[] = {"open", "met", "open", "missed"};
  return "<span class=\"verdict " + std::string(kStyles[std::clamp(grade, 0, 3)]) + "\">grade " +
         std::to_string(grade) + "</span>";
}

std::string scale_html(const ColourScale& scale) {
  std::string stops;
  for (const PageColour& colour : scale.colours) stops += (stops.empty() ? "" : ", ") + css_colour(colour);
  const auto end = [&](double value) {
    return "<span>" + escaped(short_number(value, 4) + " " + scale.unit) + "</span>";
  };
  return "<div class=\"scale\">" + end(scale.low) + "<i style=\"background: linear-gradient(to right, " + stops +
         ")\"></i>" + end(scale.high) + "<b>" + escaped(scale.meaning) + "</b></div>\n";
}

double descriptor(const GrainEntry& grain, const char* name) {
  const auto found = grain.shape.descriptors.find(name);
  return found == grain.shape.descriptors.end() ? std::nan("") : found->second;
}

std::string number(double value, int digits = kDigits) { return std::isnan(value) ? "-" : short_number(value, digits); }

std::string failed_names(const GrainEntry& grain) {
  std::string names;
  for (const catalog::Check& check : grain.shape.checks)
    if (!check.passed) names += (names.empty() ? "" : ", ") + check.name;
  return names.empty() ? "-" : names;
}

// ---- All grains

std::string lead(const DigitizingReport& report) {
  if (report.grains.empty()) return "Outlines alone; no solids were asked for.";
  std::array<int, 4> grades{};
  int rejected = 0;
  for (const GrainEntry& grain : report.grains)
    grain.refusal.empty() ? ++grades[static_cast<std::size_t>(std::clamp(grain.grade, 0, 3))] : ++rejected;
  std::string text = std::to_string(grades[1] + grades[2] + grades[3]) + " shapes: ";
  for (int grade = 1; grade <= 3; ++grade)
    text += std::to_string(grades[static_cast<std::size_t>(grade)]) + " of grade " + std::to_string(grade) + " (" +
            catalog::grade_meaning(grade) + ")" + (grade < 3 ? ", " : "");
  return text + "; " + std::to_string(rejected) + " rejected.";
}

std::string overview_row(const GrainEntry& grain) {
  const double volume = grain.shape.mass_properties.volume;
  std::string row = "<tr><td>";
  if (grain.colour) row += "<i class=\"swatch\" style=\"background: " + css_colour(*grain.colour) + "\"></i> ";
  row += "<a href=\"#" + anchor(grain.name) + "\">" + escaped(grain.name) + "</a></td>";
  if (!grain.refusal.empty())
    return row + "<td class=\"verdict missed\">rejected</td><td colspan=\"6\"></td><td></td></tr>\n";
  row += "<td>" + grade_html(grain.grade) + "</td>";
  for (const double value : {volume * 1e9, 1e3 * std::cbrt(6 * volume / std::numbers::pi),
                             descriptor(grain, "sphericity_wadell"), descriptor(grain, "convexity_volume_ratio"),
                             descriptor(grain, "zingg_s_over_i"), descriptor(grain, "zingg_i_over_l")})
    row += "<td class=\"number\">" + number(value, 4) + "</td>";
  return row + "<td>" + escaped(failed_names(grain)) + "</td></tr>\n";
}

std::string overview(const DigitizingReport& report) {
  if (report.grains.empty()) return "";
  std::string rows =
      "<table>\n<tr><th>grain</th><th>grade</th><th class=\"number\">volume [mm³]</th><th class=\"number\">diameter of "
      "equal volume [mm]</th><th class=\"number\">sphericity (Wadell)</th><th class=\"number\">convexity</th><th "
      "class=\"number\">S/I</th><th class=\"number\">I/L</th><th>checks not passed</th></tr>\n";
  for (const GrainEntry& grain : report.grains) rows += overview_row(grain);
  return section("All grains", rows + "</table>\n");
}

// ---- One grain

std::string checks_html(const GrainEntry& grain) {
  std::string rows =
      "<table>\n<tr><th>check</th><th>result</th><th class=\"number\">figure</th><th>meaning</th></tr>\n";
  for (const catalog::Check& check : grain.shape.checks)
    rows += "<tr><td>" + escaped(check.name) + "</td><td class=\"verdict " + (check.passed ? "met" : "missed") + "\">" +
            (check.passed ? "passed" : "not passed") + "</td><td class=\"number\">" + number(check.figure) +
            "</td><td>" + escaped(check.detail) + "</td></tr>\n";
  return rows + "</table>\n";
}

std::string folded(const std::string& title, const std::string& body, bool is_open) {
  return std::string("<details") + (is_open ? " open=\"open\"" : "") + "><summary>" + escaped(title) + "</summary>\n" +
         body + "</details>\n";
}

std::string descriptors_html(const GrainEntry& grain) {
  Table table({"descriptor (SI units)", "value"}, 1);
  table.add({"volume [m³]", number(grain.shape.mass_properties.volume)});
  for (const auto& [name, value] : grain.shape.descriptors) table.add({name, number(value)});
  table.add({"faces", std::to_string(grain.face_count)});
  return table.html();
}

std::string provenance_html(const catalog::Provenance& provenance) {
  Table table({"made from", ""});
  table.add({"source", provenance.source_file});
  table.add({"SHA-256 of the source", provenance.source_sha256});
  table.add({"made by", provenance.tool_version});
  table.add({"options", provenance.options});
  return table.html();
}

std::string grain_html(const GrainEntry& grain) {
  std::string body = "<h3 id=\"" + anchor(grain.name) + "\">" + escaped(grain.name);
  if (!grain.refusal.empty()) {
    body += " <span class=\"verdict missed\">rejected</span></h3>\n";
    return body + "<div class=\"warning\">" + escaped(grain.refusal) + "</div>\n" + pictures_html(grain.pictures) +
           notes_html(grain.notes);
  }
  body += " " + grade_html(grain.grade) + "</h3>\n" + pictures_html(grain.pictures);
  if (grain.scale) body += scale_html(*grain.scale);
  body += notes_html(grain.notes);
  const auto failed = std::count_if(grain.shape.checks.begin(), grain.shape.checks.end(),
                                    [](const catalog::Check& check) { return !check.passed; });
  body += folded(std::to_string(grain.shape.checks.size()) + " checks, " + std::to_string(failed) + " not passed",
                 checks_html(grain), failed > 0);
  body += folded("figures", descriptors_html(grain), false);
  return body + folded("provenance", provenance_html(grain.shape.provenance), false);
}

std::string source_html(const SourceEntry& source) {
  std::string body = notes_html(source.notes) + pictures_html(source.pictures);
  for (const PageTable& table : source.tables) body += table_html(table);
  if (!source.plots.empty()) {
    body += "<div class=\"plots\">\n";
    for (const LinePlot& plot : source.plots) body += "<div>" + svg(plot) + "</div>\n";
    body += "</div>\n";
  }
  return section(source.name, body);
}

}  // namespace

std::string digitizing_report_html(const DigitizingReport& report) {
  std::string page = page_head(report.title + " - Talus digitising") + "<h1>" + escaped(report.title) + "</h1>\n" +
                     paragraph(lead(report), "lead") + notes_html(report.notes) + overview(report);
  for (const SourceEntry& source : report.sources) page += source_html(source);
  std::string grains, rejected;
  for (const GrainEntry& grain : report.grains) (grain.refusal.empty() ? grains : rejected) += grain_html(grain);
  return page + section("Grains", grains) + section("Rejected", rejected) + kPageEnd;
}

}  // namespace postprocess
