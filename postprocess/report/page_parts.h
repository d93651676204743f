// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "postprocess/report/base64.h"
#include "postprocess/report/embedded.h"
#include "postprocess/svg_plot.h"

namespace postprocess {

// What HTML pages are put together from. Texts are escaped here.

/// Rows of cells; cells are text and are escaped, a heading that ends in "]" or starts a number column is
/// right-aligned.
class Table {
 public:
  explicit Table(std::vector<std::string> headings, std::size_t first_number_column = 99)
      : first_number_column_(first_number_column) {
    add_row(headings, "th");
  }
  void add(const std::vector<std::string>& cells) { add_row(cells, "td"); }
  std::string html() const { return "<table>\n" + rows_ + "</table>\n"; }

 private:
  void add_row(const std::vector<std::string>& cells, const std::string& tag) {
    rows_ += "<tr>";
    for (std::size_t c = 0; c < cells.size(); ++c)
      rows_ +=
          "<" + tag + (c >= first_number_column_ ? " class=\"number\">" : ">") + escaped(cells[c]) + "</" + tag + ">";
    rows_ += "</tr>\n";
  }
  std::size_t first_number_column_;
  std::string rows_;
};

inline std::string section(const std::string& title, const std::string& body) {
  return body.empty() ? "" : "<section>\n<h2>" + escaped(title) + "</h2>\n" + body + "</section>\n";
}

inline std::string paragraph(const std::string& text, const char* style = "") {
  return std::string("<p") + (*style ? std::string(" class=\"") + style + "\"" : "") + ">" + escaped(text) + "</p>\n";
}

/// A PNG within the page.
inline std::string figure(const std::string& png, const std::string& caption) {
  return "<figure><img alt=\"" + escaped(caption) + "\" src=\"data:image/png;base64," + base64(png) +
         "\"/><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

/// Everything before the first heading.
inline std::string page_head(const std::string& title) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
         escaped(title) + "</title>\n<style>\n" + kReportStyle + "</style>\n</head>\n<body>\n<main>\n";
}

inline constexpr char kPageEnd[] = "</main>\n</body>\n</html>\n";

}  // namespace postprocess
