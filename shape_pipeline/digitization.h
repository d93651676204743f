// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "catalog/separate_bodies.h"
#include "catalog/shape_record.h"
#include "shape_pipeline/mesh_remeshing.h"
#include "shape_pipeline/point_cloud.h"
#include "shape_pipeline/surface_reconstruction.h"
#include "shape_pipeline/virtual_scan.h"

namespace shape_pipeline {

struct DigitizationOptions {
  double metres_per_unit = 1;                                        // of the file's coordinates
  bool drops_nan_points = false;                                     // of clouds; else such a file is refused
  catalog::SeparateBodies bodies = catalog::SeparateBodies::refuse;  // of meshes, see RepairOptions
  ReconstructionOptions reconstruction;
  RemeshingOptions remeshing;
  std::optional<double> sieve_size;  // rescale so that the intermediate axis has this length [m]
};

/// From a scan file to a shape: read, reconstruct (cloud) or repair (mesh), limit the faces, check, bring to centroid
/// and principal axes, describe. Name and provenance are left to the caller. With `truth` the errors against it are
/// checked and described (before rescaling). Throws InputError, with the file named, for what cannot become a solid.
catalog::ShapeRecord digitize(const std::filesystem::path& scan, const DigitizationOptions& options,
                              const std::optional<ScanTruth>& truth = std::nullopt);

/// The same from a cloud in metres; `scan` names it in refusals, `made` are the checks that led to it.
catalog::ShapeRecord digitize_cloud(const PointCloud& cloud, const std::filesystem::path& scan,
                                    const DigitizationOptions& options, const std::vector<catalog::Check>& made);

/// The mesh moved to its centroid and turned to its principal axes, with mass properties in that frame and the mesh's
/// own frame for its source's.
catalog::ShapeRecord in_principal_frame(const catalog::TriangleMesh& mesh);

}  // namespace shape_pipeline
