// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/io/checkpoint.h"

#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "catalog/input_error.h"
#include "dem_gpu/broad_phase/neighbour_list.h"
#include "dem_gpu/io/hdf5_file.h"
#include "dem_gpu/periodic/ghosts.h"

namespace dem_gpu {
namespace {

constexpr const char* kKind = "talus-checkpoint";
constexpr int kVersion = 8;
constexpr std::int64_t kLocalRealBytes = sizeof(LocalReal);

/// A whole checkpoint that does not fit the simulation: no reason to look at an earlier one.
class ForeignCheckpoint : public catalog::InputError {
 public:
  using catalog::InputError::InputError;
};

/// Visits every column and account that a checkpoint holds, by name: one list serves writing and reading.
template <class StateType, class Visitor>
void visit_state(StateType& state, Visitor&& visit) {
  auto& b = state.bodies;
  visit("bodies/active", b.active);
  visit("bodies/position", b.position);
  visit("bodies/orientation", b.orientation);
  visit("bodies/velocity", b.velocity);
  visit("bodies/angular_velocity", b.angular_velocity);
  visit("bodies/force", b.force);
  visit("bodies/torque", b.torque);
  visit("bodies/contact_share", b.contact_share);
  visit("bodies/listed_position", b.listed_position);
  visit("bodies/listed_displacement", b.listed_displacement);
  auto& c = state.contacts;
  visit("contacts/key", c.key);
  visit("contacts/row", c.row);
  visit("contacts/torques", c.torques);
  visit("contacts/point", c.point);
  visit("contacts/peak_overlap", c.peak_overlap);
  visit("contacts/peak_rate", c.peak_rate);
  visit("contacts/is_truncated", c.is_truncated);
  visit("contacts/cache_begin", c.cache_begin);
  visit("contacts/separating", c.separating);
  visit("contacts/facet_begin", c.facet_begin);
  visit("contacts/facet", c.facet);
  visit("contacts/turning_displacement", c.turning_displacement);
  visit("contacts/spring_normal", c.spring_normal);
  visit("contacts/elastic_work", c.elastic_work);
  visit("contacts/orbit_loss", c.orbit_loss);
  visit("contacts/tangential_energy", c.tangential_energy);
  visit("contacts/loss_normal", c.loss_normal);
  visit("contacts/loss_shear", c.loss_shear);
  visit("contacts/wall_work", c.wall_work);
  visit("contacts/last_elastic_force", c.last_elastic_force);
  visit("contacts/last_elastic_torque_a", c.last_elastic_torque_a);
  visit("contacts/last_elastic_torque_b", c.last_elastic_torque_b);
  visit("contacts/last_damping_force", c.last_damping_force);
  visit("contacts/last_friction_force", c.last_friction_force);
  visit("contacts/last_friction_couple", c.last_friction_couple);
  visit("contacts/wall_impulse", c.wall_impulse);
  visit("contacts/wall_angular_impulse", c.wall_angular_impulse);
  visit("incident/first", state.incident_first);
  visit("incident/entry", state.incident);
  auto& a = state.accounts;
  visit("accounts/loss_normal", a.loss_normal);
  visit("accounts/loss_shear", a.loss_shear);
  visit("accounts/wall_work", a.wall_work);
  visit("accounts/wall_work_taken", a.wall_work_taken);
  visit("accounts/wall_impulse", a.wall_impulse);
  visit("accounts/wall_angular_impulse", a.wall_angular_impulse);
  visit("ghosts/id", state.ghosts.id);
  visit("ghosts/wraps", state.ghosts.wraps);
}

/// How a column's elements stand in the file: as rows of numbers.
template <class T>
struct Stored {
  static constexpr bool kIsRow = std::is_same_v<T, Vec3> || std::is_same_v<T, Quaternion> ||
                                 std::is_same_v<T, ContactRow> || std::is_same_v<T, ContactTorques>;
  using Number = std::conditional_t<
      kIsRow, Real,
      std::conditional_t<sizeof(T) == 1, std::uint8_t,
                         std::conditional_t<sizeof(T) == 8 && std::is_integral_v<T>, std::int64_t,
                                            std::conditional_t<std::is_integral_v<T>, std::int32_t, T>>>>;
  static constexpr std::size_t kColumns = kIsRow ? sizeof(T) / sizeof(Real) : 1;
};

template <class T>
std::vector<typename Stored<T>::Number> to_numbers(const std::vector<T>& values) {
  using Number = typename Stored<T>::Number;
  std::vector<Number> numbers(values.size() * Stored<T>::kColumns);
  if constexpr (sizeof(T) == Stored<T>::kColumns * sizeof(Number)) {
    if (!values.empty()) std::memcpy(numbers.data(), values.data(), values.size() * sizeof(T));
  } else {
    for (std::size_t i = 0; i < values.size(); ++i) numbers[i] = static_cast<Number>(values[i]);
  }
  return numbers;
}

template <class T>
std::vector<T> from_numbers(const std::vector<typename Stored<T>::Number>& numbers) {
  std::vector<T> values(numbers.size() / Stored<T>::kColumns);
  if constexpr (sizeof(T) == Stored<T>::kColumns * sizeof(typename Stored<T>::Number)) {
    if (!values.empty()) std::memcpy(static_cast<void*>(values.data()), numbers.data(), values.size() * sizeof(T));
  } else {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<T>(numbers[i]);
  }
  return values;
}

/// FNV-1a over what must be equal for a checkpoint to fit: bodies, shapes, walls, laws, optional columns, step.
/// (Fowler, Noll & Vo)
std::int64_t fingerprint(const Model& model) {
  std::uint64_t hash = 14695981039346656037ull;
  const auto mix = [&](const void* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 1099511628211ull;
  };
  const auto mix_all = [&](const auto& values) {
    if (!values.empty()) mix(values.data(), values.size() * sizeof(values[0]));
  };
  mix(&model.time_step, sizeof(model.time_step));
  mix(&model.scene.gravity, sizeof(Vec3));
  mix_all(to_host(model.bodies.mass));
  mix_all(to_host(model.bodies.inertia));
  mix_all(to_host(model.bodies.bounding_radius));
  mix_all(to_host(model.bodies.shape));
  mix_all(to_host(model.bodies.material));
  for (const Body& body : model.scene.bodies) mix(&body.is_fixed, sizeof(bool));
  mix_all(to_host(model.shapes.columns.vertices));
  mix_all(to_host(model.shapes.columns.depth_planes));
  mix_all(to_host(model.meshes.planes));
  mix_all(to_host(model.meshes.vertices));
  const WallSet at_start(model.scene, static_cast<int>(model.scene.shapes.size()));
  for (std::size_t w = 0; w < model.scene.walls.size(); ++w) {
    const Wall& wall = model.scene.walls[w];
    mix(wall.name.data(), wall.name.size());
    mix(wall.contact_class.data(), wall.contact_class.size());
    mix(&wall.motion, sizeof(Motion));
    const WallRecord& record = at_start.records()[w];
    for (const Real value : {static_cast<Real>(record.kind), static_cast<Real>(wall.material), record.length,
                             record.base_radius, record.top_radius, record.thickness,
                             static_cast<Real>(record.solid_within), wall.removed_at.value_or(Real(-1))})
      mix(&value, sizeof(value));
    mix(&record.point, sizeof(Vec3));
    mix(&record.direction, sizeof(Vec3));
  }
  if (model.scene.outflow) mix(&*model.scene.outflow, sizeof(Outflow));
  if (model.scene.periodic) {
    const PeriodicLattice lattice = lattice_of(model.scene);
    mix(&lattice, sizeof(lattice));
  }
  const ContactFeatures& features = model.features;
  for (const bool has : {features.has_friction, features.has_ledger, features.has_walls, features.has_polyhedra,
                         features.has_friction_couples, features.has_spheres, features.has_meshes})
    mix(&has, sizeof(has));
  if (model.scene.friction) mix(&*model.scene.friction, sizeof(Friction));
  const std::size_t law = model.scene.polyhedral_law.index();
  mix(&law, sizeof(law));
  const auto pairs = to_host(model.pairs);
  for (const PairProperties& pair : pairs) {
    for (const Real value : {pair.damping_ratio, pair.friction_coefficient, pair.effective_modulus, pair.sphere_damping,
                             pair.tangential_stiffness_ratio, pair.rolling_friction, pair.adhesion})
      mix(&value, sizeof(value));
  }
  std::visit([&](const auto& chosen) { mix(&chosen.stiffness, sizeof(Real)); }, model.scene.polyhedral_law);
  if (const DepthPotential* depth = depth_potential(model.scene.polyhedral_law)) mix(&depth->depth_cap, sizeof(Real));
  if (const auto* hardening = std::get_if<HardeningDepthPotential>(&model.scene.polyhedral_law))
    mix(&hardening->hardening, sizeof(Real));
  const std::size_t sphere_law = model.scene.sphere_law.index();
  mix(&sphere_law, sizeof(sphere_law));
  if (const auto* linear = std::get_if<LinearSpring>(&model.scene.sphere_law)) mix(&linear->stiffness, sizeof(Real));
  return static_cast<std::int64_t>(hash);
}

template <class T>
void write_column(io::Hdf5Writer& file, const std::string& name, const T& column) {
  using Element = typename T::value_type;
  std::vector<Element> values(column.size());
  thrust::copy(column.begin(), column.end(), values.begin());
  file.write(name, to_numbers(values), Stored<Element>::kColumns);
}

template <class T>
void read_column(const io::Hdf5Reader& file, const std::string& name, T& column) {
  using Element = typename T::value_type;
  const auto values =
      from_numbers<Element>(file.read<typename Stored<Element>::Number>(name, Stored<Element>::kColumns));
  column.resize(values.size());
  thrust::copy(values.begin(), values.end(), column.begin());
}

void read_one(const std::filesystem::path& path, const Model& model, State& state) {
  const io::Hdf5Reader file(path, kKind, std::numeric_limits<int>::max());
  if (file.version() != kVersion)
    throw ForeignCheckpoint(path.string() + ": is of checkpoint version " + std::to_string(file.version()) +
                            ", this program resumes from version " + std::to_string(kVersion) +
                            " alone; resume with the Talus that wrote it, or start the run again");
  if (const std::int64_t bytes = file.integer_attribute("local_real_bytes"); bytes != kLocalRealBytes)
    throw ForeignCheckpoint(path.string() + ": written in " + (bytes == sizeof(double) ? "double" : "mixed") +
                            " precision, this build computes in " + kPrecision +
                            " precision; resume with the build that wrote it");
  if (file.integer_attribute("scene") != fingerprint(model))
    throw ForeignCheckpoint(path.string() + ": belongs to another scene (bodies, walls, laws or time step differ); " +
                            "resume with the scene it was written by");
  visit_state(state, [&](const std::string& name, auto& column) { read_column(file, name, column); });
  const auto ranges = file.read<std::int32_t>("contacts/ranges", 2);
  for (int kind = 0; kind < kContactKinds; ++kind)
    state.range[kind] = {ranges[2 * static_cast<std::size_t>(kind)], ranges[2 * static_cast<std::size_t>(kind) + 1]};
  state.step = file.integer_attribute("step");
  state.skin = file.double_attribute("skin");
  state.listed_time = file.double_attribute("listed_time");
  state.list_is_stale = file.integer_attribute("list_is_stale") != 0;
  Accounts& accounts = state.accounts;
  accounts.wall_load_time = file.double_attribute("wall_load_time");
  accounts.initial_kinetic = file.double_attribute("initial_kinetic");
  accounts.initial_elastic = file.double_attribute("initial_elastic");
  accounts.initial_gravitational = file.double_attribute("initial_gravitational");
  accounts.removed_energy = file.double_attribute("removed_energy");
  accounts.removed_gravitational = file.double_attribute("removed_gravitational");
  accounts.largest_throughput = file.double_attribute("largest_throughput");
  accounts.largest_overlap = file.double_attribute("largest_overlap");
  accounts.largest_rate = file.double_attribute("largest_rate");
  accounts.list_rebuilds = file.integer_attribute("list_rebuilds");
  state.walls.move_to(state.time(model));
  if (model.scene.periodic) fit_columns_to_ghosts(model, state);
  state.list_is_worn.assign(1, 0);
  ++state.columns_version;
  // Not kept: how long pairs may wait changes nothing but time.
  if (model.features.has_waiting_pairs) state.contacts.apart_until.assign(state.contacts.key.size(), Real(0));
}

}  // namespace

void write_checkpoint_file(const std::filesystem::path& run_folder, const Model& model, const State& state) {
  const std::filesystem::path path = run_folder / "checkpoint.h5", next = run_folder / "checkpoint_next.h5";
  {
    io::Hdf5Writer file(next, kKind, kVersion);
    file.write_attribute("local_real_bytes", kLocalRealBytes);
    file.write_attribute("scene", fingerprint(model));
    file.write_attribute("step", state.step);
    file.write_attribute("skin", static_cast<double>(state.skin));
    file.write_attribute("listed_time", static_cast<double>(state.listed_time));
    file.write_attribute("list_is_stale", static_cast<std::int64_t>(state.list_is_stale));
    const Accounts& accounts = state.accounts;
    file.write_attribute("wall_load_time", accounts.wall_load_time);
    file.write_attribute("initial_kinetic", accounts.initial_kinetic);
    file.write_attribute("initial_elastic", accounts.initial_elastic);
    file.write_attribute("initial_gravitational", accounts.initial_gravitational);
    file.write_attribute("removed_energy", accounts.removed_energy);
    file.write_attribute("removed_gravitational", accounts.removed_gravitational);
    file.write_attribute("largest_throughput", accounts.largest_throughput);
    file.write_attribute("largest_overlap", accounts.largest_overlap);
    file.write_attribute("largest_rate", accounts.largest_rate);
    file.write_attribute("list_rebuilds", accounts.list_rebuilds);
    visit_state(state, [&](const std::string& name, const auto& column) { write_column(file, name, column); });
    std::vector<std::int32_t> ranges;
    for (const ContactRange& range : state.range) {
      ranges.push_back(range.first);
      ranges.push_back(range.last);
    }
    file.write("contacts/ranges", ranges, 2);
    file.commit();
  }
  // Whatever moment this stops at, one whole checkpoint is there.
  if (std::filesystem::exists(path)) std::filesystem::rename(path, run_folder / "checkpoint_previous.h5");
  std::filesystem::rename(next, path);
}

std::string read_checkpoint_file(const std::filesystem::path& run_folder, const Model& model, State& state) {
  const std::filesystem::path path = run_folder / "checkpoint.h5", previous = run_folder / "checkpoint_previous.h5";
  try {
    read_one(path, model, state);
    return "";
  } catch (const ForeignCheckpoint&) {
    throw;
  } catch (const catalog::InputError& error) {
    if (!std::filesystem::exists(previous)) throw;
    try {
      read_one(previous, model, state);
      return std::string("checkpoint.h5 is ") + (std::filesystem::exists(path) ? "damaged (" : "missing (") +
             error.what() + "); went on from checkpoint_previous.h5";
    } catch (const catalog::InputError&) {
      throw error;  // the fault of the last checkpoint is the one to tell
    }
  }
}

}  // namespace dem_gpu
