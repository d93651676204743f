// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "dem_gpu/bodies/model_state.h"
#include "dem_gpu/core/pass.h"

namespace dem_gpu {

// One pass per kind of contact. Each looks for overlap in its range of the contact table and completes the contact.
std::unique_ptr<Pass> make_polyhedron_contacts_pass(const Scene& scene);         // polyhedron_polyhedron
std::unique_ptr<Pass> make_polyhedron_wall_contacts_pass(const Scene& scene);    // polyhedron_wall
std::unique_ptr<Pass> make_polyhedron_object_contacts_pass(const Scene& scene);  // polyhedron_object
std::unique_ptr<Pass> make_sphere_contacts_pass(const Scene& scene);             // sphere_sphere
std::unique_ptr<Pass> make_sphere_polyhedron_contacts_pass(const Scene& scene);  // sphere_polyhedron
std::unique_ptr<Pass> make_sphere_wall_contacts_pass(const Scene& scene);        // sphere_wall
std::unique_ptr<Pass> make_sphere_object_contacts_pass(const Scene& scene);      // sphere_object
std::unique_ptr<Pass> make_polyhedron_mesh_contacts_pass(const Scene& scene);    // polyhedron_mesh
std::unique_ptr<Pass> make_sphere_mesh_contacts_pass(const Scene& scene);        // sphere_mesh

/// Before them: contacts of spheres that pass from a wall to one welded to it.
std::unique_ptr<Pass> make_seam_crossings_pass();

}  // namespace dem_gpu
