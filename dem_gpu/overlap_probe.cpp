// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/overlap_probe.h"

#include <stdexcept>

#include "catalog/input_error.h"
#include "dem_gpu/contacts/body_overlap.h"

namespace dem_gpu {

struct OverlapProbe::Columns {
  HostShapeColumns shapes;
  PolyhedralLaw law;

  int part_pairs() const { return shapes.shapes[0].part_count * shapes.shapes[1].part_count; }
};

namespace {

constexpr int kShapeA = 0, kShapeB = 1;

Pose to_pose(const BodyPose& pose) { return {rotation_matrix(pose.orientation), pose.position, pose.scale}; }

/// The depth field needs its cap; the volume law has no field.
std::optional<Real> depth_cap_of(const PolyhedralLaw& law) {
  const DepthPotential* depth = depth_potential(law);
  return depth ? std::optional(depth->depth_cap) : std::nullopt;
}

template <class Integrals>
void integrate(const ShapeView& shapes, const Pose& a, const Pose& b, SeparatingPlane* separating,
               Integrals& integrals) {
  if (!integrate_bodies(shapes, kShapeA, kShapeB, a, b, separating, integrals).is_whole)
    throw std::runtime_error("overlap probe: a clipped face falls into more pieces, or has more depths, than fit");
}

template <class Law>
bool find_contact(const ShapeView& shapes, const Law& law, const PosePair& poses, SeparatingPlane* separating,
                  ElasticContact& contact) {
  const Pose a = to_pose(poses.a), b = to_pose(poses.b);
  auto integrals = empty_integrals(law, smaller_diameter(shapes, kShapeA, kShapeB, a, b), a.scale, b.scale);
  integrate(shapes, a, b, separating, integrals);
  return integrals.to_contact(law, a, contact);
}

}  // namespace

OverlapProbe::OverlapProbe(const Shape& a, const Shape& b, const PolyhedralLaw& law) {
  for (const Shape* shape : {&a, &b})
    if (!std::holds_alternative<PolyhedralShape>(shape->geometry))
      throw catalog::InputError("shape '" + shape->name + "': the overlap probe takes polyhedra only");
  columns_ = std::make_unique<Columns>(Columns{make_host_shape_columns({a, b}, depth_cap_of(law)), law});
}
OverlapProbe::~OverlapProbe() = default;
OverlapProbe::OverlapProbe(OverlapProbe&&) noexcept = default;

OverlapSolid OverlapProbe::overlap(const PosePair& poses) const {
  const Pose a = to_pose(poses.a), b = to_pose(poses.b);
  SeparationCache cache(columns_->part_pairs(), 0);
  VolumeIntegrals integrals;
  integrate(view(columns_->shapes), a, b, cache.data(), integrals);
  if (!(integrals.volume > 0)) return {};
  const Real square = a.scale * a.scale, cube = square * a.scale;
  return {cube * integrals.volume, square * (a.rotation * integrals.area), cube * (a.rotation * integrals.area_moment),
          a.position + a.scale * (a.rotation * integrals.centroid())};
}

ProbeContact OverlapProbe::contact(const PosePair& poses) const {
  SeparationCache cache(columns_->part_pairs(), 0);
  ElasticContact contact;
  const bool is_touching = std::visit(
      [&](const auto& law) { return find_contact(view(columns_->shapes), law, poses, cache.data(), contact); },
      columns_->law);
  if (!is_touching) return {};
  return {contact.force, contact.torque_a, contact.point, contact.depth, contact.stiffness};
}

int OverlapProbe::count_contacts(std::span<const PosePair> pairs, SeparationCache& cache) const {
  const ShapeView shapes = view(columns_->shapes);
  const int part_pairs = columns_->part_pairs();
  cache.resize(pairs.size() * part_pairs, 0);
  return std::visit(
      [&](const auto& law) {
        int touching = 0;
        ElasticContact contact;
        for (std::size_t i = 0; i < pairs.size(); ++i)
          touching += find_contact(shapes, law, pairs[i], cache.data() + i * part_pairs, contact);
        return touching;
      },
      columns_->law);
}

}  // namespace dem_gpu
