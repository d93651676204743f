// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/bodies/model_state.h"

namespace dem_gpu {

/// Fills the facet lists of all contacts with meshes: facets whose cells come within the skin of a body's bounding
/// ball, ascending. For the bodies' and walls' present places; good until the neighbour list is built anew.
void list_facets(const Model& model, State& state, ContactColumns& contacts);

}  // namespace dem_gpu
