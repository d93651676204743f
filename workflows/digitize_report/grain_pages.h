// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"
#include "postprocess/digitizing_report.h"
#include "shape_pipeline/grain_pictures.h"
#include "workflows/digitize_batch.h"

namespace workflows {

/// Puts together the grains of a page. Pictures are made of the first hundred outcomes only, so that the page opens in
/// a browser; the rest stands in its tables, with a notice.
class GrainPages {
 public:
  /// Of the outcomes of a batch, which stay where they are.
  GrainPages(const std::filesystem::path& catalog, const std::vector<DigitizedScan>& outcomes);

  struct Grain {
    const DigitizedScan* outcome = nullptr;
    postprocess::GrainEntry entry;
    shape_pipeline::GrainView view;  // of the shape, in its frame
    bool is_drawn = false;           // one of those that get pictures
    bool has_shape() const { return entry.refusal.empty(); }
  };
  std::vector<Grain>& grains() { return grains_; }

  /// The shape's surface as a picture.
  static void add_result(Grain& grain);
  /// The map of its distance from its source, with its scale and figures.
  static void add_map(Grain& grain, const shape_pipeline::DeviationMap& map);
  /// A picture as the first of the grain.
  static void add_input(Grain& grain, const shape_pipeline::ColourImage& picture, const std::string& caption);

  /// The page, named for the catalogue.
  postprocess::DigitizingReport finished(std::vector<postprocess::SourceEntry> sources);

 private:
  std::string title_;
  std::vector<Grain> grains_;
  bool are_all_drawn_ = true;
};

postprocess::PagePicture page_picture(const shape_pipeline::ColourImage& image, const std::string& caption);

/// A length with a unit that suits it: "12.5 um".
std::string length_text(double metres);

}  // namespace workflows
