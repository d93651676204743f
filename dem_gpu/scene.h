// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "catalog/convex_part.h"
#include "catalog/triangle_mesh.h"
#include "dem_gpu/contacts/laws/depth_potential.h"
#include "dem_gpu/contacts/laws/hardening_depth_potential.h"
#include "dem_gpu/contacts/laws/hertz.h"
#include "dem_gpu/contacts/laws/linear_spring.h"
#include "dem_gpu/contacts/laws/overlap_volume.h"
#include "dem_gpu/core/quaternion.h"
#include "dem_gpu/core/vec3.h"
#include "dem_gpu/run_promise.h"

namespace dem_gpu {

// A Scene is everything a run needs, in SI units, built by the scene reader or in code. Plain structs; nothing later
// sees text. check(scene) below refuses what cannot be simulated.

struct SphereShape {
  Real radius = 0;  // [m]
};

/// Convex polyhedron (one part) or non-convex body as a partition into convex parts.
/// Frame: centre of mass at the origin, principal axes along x, y, z.
struct PolyhedralShape {
  std::vector<catalog::ConvexPart> parts;  // [m], at scale 1
};

struct Shape {
  std::string name;
  std::variant<SphereShape, PolyhedralShape> geometry;
  Real volume = 0;         // [m3] at scale 1
  Vec3 principal_inertia;  // of density 1 about the centre [m5] at scale 1
};

/// Makes a Shape from parts given in any frame: moves them to the centre of mass and principal axes.
/// Throws catalog::InputError if a part is flat, open, not convex, has too many vertices (see kMaxPartVertices),
/// or if parts overlap by more than 0.1 % of the volume.
Shape polyhedral_shape(const std::string& name, const std::vector<catalog::ConvexPart>& parts);
Shape sphere_shape(const std::string& name, Real radius);
/// Box with edges `size` [m], one part.
catalog::ConvexPart box_part(const Vec3& size);

struct Material {
  std::string name;
  Real density = 0;           // [kg/m3]; not used by walls
  Real youngs_modulus = 5e6;  // [Pa], used by the Hertz law only
  Real poisson_ratio = 0.3;   // [-], used by the Hertz law only, with Mindlin's tangential stiffness
};

/// Contact of material a with material b.
struct ContactProperties {
  Real restitution = 0.5;           // normal, [0, 1]; at least 0.01 where there are polyhedra
  Real friction_coefficient = 0.5;  // Coulomb, >= 0
  // Of sphere contacts alone.
  Real rolling_friction = 0;  // largest rolling couple / (R* F_n), [0, 1] [-]
  Real adhesion = 0;          // work of adhesion, >= 0 [J/m2]
};

struct Body {
  int shape = 0;     // index into Scene::shapes
  int material = 0;  // index into Scene::materials
  Real scale = 1;    // uniform, > 0
  Vec3 position;     // of the centre of mass [m]
  Quaternion orientation;
  Vec3 velocity;          // [m/s]
  Vec3 angular_velocity;  // world frame [rad/s]
  bool is_fixed = false;  // held where it is: meets others as a body of infinite mass; must be at rest
};

// World objects. The solid is behind the surface: particles live on the side the normal points to (plane, disc), inside
// or outside (cylinder, cone, ball).
struct Plane {
  Vec3 point;   // [m]
  Vec3 normal;  // unit
};
/// Round plate of finite radius: a gate or an end plate. Without a thickness all that is behind it is solid.
struct Disc {
  Vec3 centre;                                   // [m]
  Vec3 normal;                                   // unit
  Real radius = 0;                               // [m]
  std::optional<Real> thickness = std::nullopt;  // [m]
};
/// Where the solid of a curved wall is: about a container that holds the bodies, or within a shaft or ball.
enum class SolidSide { around, within };
/// Cylinder from `base` along the unit `axis` over `length`, its ends open.
struct Cylinder {
  Vec3 base;        // centre of the lower end [m]
  Vec3 axis;        // unit
  Real length = 0;  // [m]
  Real radius = 0;  // [m]
  SolidSide solid = SolidSide::around;
};
/// Cone frustum, its ends open; radius changes linearly from `base_radius` to `top_radius` over `length`.
struct Cone {
  Vec3 base;             // [m]
  Vec3 axis;             // unit
  Real length = 0;       // [m]
  Real base_radius = 0;  // [m]
  Real top_radius = 0;   // [m]
  SolidSide solid = SolidSide::around;
};
struct Ball {
  Vec3 centre;      // [m]
  Real radius = 0;  // [m]
  SolidSide solid = SolidSide::around;
};
/// Convex volume object: a lifter, a block.
struct VolumeObject {
  catalog::ConvexPart part;  // world frame at time 0 [m]
};
/// Triangle mesh. The solid lies behind its triangles, whose corners run counter-clockwise as seen from outside the
/// solid; a closed mesh is a solid body, a container a hole in a solid all about it.
struct MeshObject {
  catalog::TriangleMesh mesh;                    // world frame at time 0 [m]
  std::optional<Real> thickness = std::nullopt;  // solid behind an open sheet [m]
  bool is_container = false;                     // closed mesh, bodies inside; either way round
  Real depth = 0;  // of the layer in which contact is computed [m]; 0: the largest body's bounding radius
};

/// Prescribed motion; none by default. Rotation about an axis, translation at constant speed, and an oscillation, which
/// all add up; the axes move along with the rotation centre.
struct Motion {
  Vec3 rotation_centre;   // a point on the axis [m]
  Vec3 angular_velocity;  // world frame [rad/s]
  Vec3 velocity;          // [m/s]
  Real start_time = 0;    // at rest before [s]
  Real ramp_time = 0;     // speed and amplitude grow linearly over this time after start_time [s]
  // Oscillation: amplitude * (sin(2 pi frequency t + phase) - sin(phase)), t from start_time.
  Vec3 amplitude{};          // of the displacement, world frame [m]
  Vec3 angular_amplitude{};  // of the turn about the axis through rotation_centre, world frame [rad]
  Real frequency = 0;        // [Hz]
  Real phase = 0;            // [rad]

  friend bool operator==(const Motion&, const Motion&) = default;
};

struct Wall {
  std::string name;  // unique
  std::variant<Plane, Disc, Cylinder, Cone, Ball, VolumeObject, MeshObject> geometry;
  int material = 0;
  std::string contact_class;  // for the ledger: "shell", "lifter", "gate", ...; the wall's name if empty
  Motion motion;
  std::string group;               // walls of one group move alike, and their loads are summed; "" for none
  std::optional<Real> removed_at;  // a gate that opens: absent from this time on [s]
};

/// Bodies whose centre passes below `height` along the unit `direction` leave the simulation (a hopper's outflow).
struct Outflow {
  Vec3 direction{0, 0, 1};  // bodies are removed where dot(position, direction) < height
  Real height = 0;          // [m]
};

/// Along an axis: what leaves the box at one end comes back in at the other.
struct PeriodicSpan {
  Real low = 0, high = 0;  // [m]
  friend bool operator==(const PeriodicSpan&, const PeriodicSpan&) = default;
};
/// A box that repeats itself along the axes that have a span. Bodies meet across its faces; walls do not repeat
/// themselves: each acts where it stands, on the bodies in the box.
struct PeriodicBox {
  std::array<std::optional<PeriodicSpan>, 3> span;  // along x, y, z
  friend bool operator==(const PeriodicBox&, const PeriodicBox&) = default;
};

using PolyhedralLaw = std::variant<DepthPotential, OverlapVolume, HardeningDepthPotential>;
/// The depth potential that a law is, hardening or not; null for the volume law.
const DepthPotential* depth_potential(const PolyhedralLaw& law);

using SphereLaw = std::variant<LinearSpring, Hertz>;

struct Friction {
  Real tangential_stiffness_ratio = Real(2) / 7;  // tangential over normal stiffness, Hertz contacts apart [-]
};

/// Steps, times and outputs of a run.
struct RunControl {
  Real end_time = 0;                       // [s]
  Real time_step = 0;                      // [s]; 0: chosen from the stiffest contact
  Real steps_per_contact = 20;             // in the stiffest contact, where time_step is 0 [-]
  Preset preset = Preset::standard;        // what the run promises; a step of one's own may break it
  Real largest_start_overlap = Real(0.1);  // accepted at time 0, share of the thinner body's least width [-]
  Real snapshot_interval = 0;              // [s]; 0: none
  Real checkpoint_interval = 0;            // [s]; 0: only at the end
  Real series_interval = 0;                // rows of the time series [s]; 0: every snapshot_interval
};

struct Scene {
  std::string name;
  Vec3 gravity{0, 0, Real(-9.81)};  // [m/s2]
  std::vector<Material> materials;
  std::vector<std::vector<ContactProperties>> contact;  // n_materials x n_materials, symmetric
  std::vector<Shape> shapes;
  std::vector<Body> bodies;
  std::vector<Wall> walls;
  std::optional<Outflow> outflow;
  std::optional<PeriodicBox> periodic;  // nullopt: no ghosts anywhere
  PolyhedralLaw polyhedral_law;
  SphereLaw sphere_law;
  std::optional<Friction> friction = Friction{};  // nullopt: frictionless, no tangential history anywhere
  bool energy_ledger = true;
  RunControl run;
};

/// Largest number of vertices, faces and corners of a face that a part may have in the engine.
inline constexpr int kMaxPartVertices = 64;
inline constexpr int kMaxPartFaces = 124;
inline constexpr int kMaxFaceCorners = 32;

/// Whether any pair of materials has rolling resistance, or adhesion.
bool has_rolling_friction(const Scene& scene);
bool has_adhesion(const Scene& scene);

/// Refuses what cannot be simulated: indices out of range, negative sizes, zero stiffness, restitution outside [0, 1],
/// two walls of one name, no bodies, fixed bodies that move, a time step longer than a fifth of the shortest contact,
/// a periodic box too narrow for its bodies, or bodies and walls that do not fit it (periodic/periodic_check.h).
/// Throws catalog::InputError with the place and the remedy.
void check(const Scene& scene);

/// Shortest contact time that the scene can make: pi sqrt(m_eff / stiffness) over face contacts of polyhedra and
/// contacts of spheres, with walls and with each other [s].
Real shortest_contact_time(const Scene& scene);

/// The time step used: run.time_step, or shortest_contact_time / steps_per_contact [s].
Real time_step(const Scene& scene);

/// Where the heaviest body strikes in stiffness_for_overlap: with its largest flat face, or with a corner like a
/// cube's.
enum class OverlapAt { face, corner };

/// Stiffness of the scene's polyhedral law [N/m3] for which the heaviest body, striking a flat wall at `speed` without
/// turning, sinks in by `largest_overlap` (share of the body's equivalent diameter).
Real stiffness_for_overlap(const Scene& scene, Real speed, Real largest_overlap, OverlapAt at = OverlapAt::face);

/// The reverse for a flat face: overlap of the heaviest body at its law's stiffness, as a share of its equivalent
/// diameter.
Real flat_overlap(const Scene& scene, Real speed);

}  // namespace dem_gpu
