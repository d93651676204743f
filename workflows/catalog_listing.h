// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "catalog/shape_catalog.h"

namespace workflows {

// What talus-catalog prints, as text for people or as one JSON object.

/// A table, one shape a line: name, volume, equivalent diameter, faces, up to four descriptors, Zingg's
/// class, levels, failed checks.
std::string list_text(const std::vector<catalog::ShapeSummary>& shapes);
std::string list_json(const std::vector<catalog::ShapeSummary>& shapes);

std::string show_text(const catalog::ShapeRecord& shape, const catalog::ShapeSummary& summary);
std::string show_json(const catalog::ShapeRecord& shape, const catalog::ShapeSummary& summary);

std::string names_json(const std::vector<catalog::ShapeSummary>& shapes);

std::string rejected_text(const std::vector<catalog::RejectedInput>& rejected);
std::string rejected_json(const std::vector<catalog::RejectedInput>& rejected);

/// Diameter of the sphere of that volume [m].
double equivalent_diameter(double volume);

}  // namespace workflows
