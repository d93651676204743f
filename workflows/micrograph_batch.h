// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "catalog/shape_catalog.h"
#include "shape_pipeline/matched_population.h"
#include "shape_pipeline/micrograph.h"
#include "workflows/digitize_batch.h"
#include "workflows/stage_tool.h"

namespace workflows {

/// How micrographs become outlines and a population, as typed.
struct MicrographSettings {
  std::string pixel, scale_bar;      // "0.5 um"; one of both
  std::string third_axis = "drawn";  // or S/I
  std::filesystem::path out;         // folder of tables; empty: beside the catalogue
  bool has_dark_grains = false;
  double least_diameter = 5;  // [pixels]
  int population = 20;        // shapes to store
  std::uint64_t seed = 1;

  bool is_asked_for() const { return !pixel.empty() || !scale_bar.empty(); }
};

/// An image with what was found in it.
struct ReadMicrograph {
  std::filesystem::path image;
  shape_pipeline::Micrograph micrograph;
};

/// True if the inputs are micrographs: images by their endings, or a pixel size or scale bar is given. Throws
/// UsageError for images and other scans in one batch.
bool are_micrographs(const DigitizeBatchOptions& options, const MicrographSettings& settings);

/// Micrographs of one powder, one after the other, into a folder: a table of descriptors (CSV), the outlines (JSON) and
/// a picture of them over the image (PNG), each named as the image. Of all outlines together a population of solids
/// goes into the catalogue, named NAME_0001, ..., NAME that of the only image or the catalogue's. What is there from
/// the same bytes with the same options is skipped; an image that cannot be read is kept as rejected. Throws like
/// DigitizeBatch.
class MicrographBatch {
 public:
  MicrographBatch(const DigitizeBatchOptions& options, const MicrographSettings& settings);
  void run();

  const DigitizeBatchOptions& options() const { return options_; }
  const std::vector<ReadMicrograph>& micrographs() const { return micrographs_; }

  /// Of the shapes, and of images that cannot be read.
  const std::vector<DigitizedScan>& outcomes() const { return outcomes_; }

 private:
  void digitize(const std::filesystem::path& image);
  void store_population();
  bool is_done(const catalog::Provenance& provenance);
  void reject(const std::filesystem::path& source, const std::string& name, const std::string& reason);
  catalog::Provenance provenance_of(const std::vector<std::filesystem::path>& images) const;
  std::string shape_name(int number) const;

  DigitizeBatchOptions options_;
  MicrographSettings settings_;
  shape_pipeline::MicrographOptions image_options_;
  shape_pipeline::PopulationOptions population_options_;
  std::vector<std::filesystem::path> images_, read_;
  std::string name_;
  std::optional<catalog::ShapeCatalog> catalog_;  // none without a population
  BatchProgress progress_;
  std::vector<shape_pipeline::Outline> outlines_;  // of all images so far [m]
  double coarsest_pixel_ = 0;                      // [m]
  std::vector<ReadMicrograph> micrographs_;
  std::vector<DigitizedScan> outcomes_;
};

}  // namespace workflows
