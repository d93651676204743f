// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "catalog/shape_record.h"
#include "shape_pipeline/matched_population.h"
#include "shape_pipeline/micrograph.h"

namespace workflows {

/// A row a whole grain: number, image, place of the outline's middle from the image's upper left corner, descriptors.
/// The header has name[unit]; what an outline lacks is left empty.
std::string outline_table(const std::string& image, const shape_pipeline::Micrograph& micrograph);

/// The outlines as JSON, in pixels, with pixel size, counts, strip, scale bar and provenance.
std::string outline_json(const shape_pipeline::Micrograph& micrograph, const catalog::Provenance& provenance);

/// What a population was made to show beside what the outlines show, as JSON.
std::string population_json(const shape_pipeline::MatchedPopulation& population, const catalog::Provenance& provenance);

}  // namespace workflows
