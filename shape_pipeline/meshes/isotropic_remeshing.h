// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "catalog/triangle_mesh.h"

namespace shape_pipeline {

/// Nearly equilateral triangles of about the given edge length [m] on the same surface (Botsch & Kobbelt 2004).
catalog::TriangleMesh isotropic_remeshing(const catalog::TriangleMesh& mesh, double edge_length);

}  // namespace shape_pipeline
