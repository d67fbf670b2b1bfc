#include "dem/state/checkpoint_arrays.h"

#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"

namespace repose::dem {
namespace {

constexpr const char* kAbsent = "absent_";  // name prefix for grains that have left
constexpr int kContactNumbers = 7;
constexpr const char* kPush = "contact_push";
constexpr const char* kEqualSince = "equal_steps_since";
constexpr const char* kEqualSince_s = "equal_steps_since_s";

std::vector<int> grains_that_are(bool present, const Checkpoint& checkpoint) {
  std::vector<int> numbers;
  for (std::size_t k = 0; k < checkpoint.grains.size(); ++k) {
    if (checkpoint.is_present[k] == present) numbers.push_back(static_cast<int>(k));
  }
  return numbers;
}

void add_grains(ArrayWriter& arrays, const Checkpoint& checkpoint, const std::vector<int>& which) {
  std::vector<std::int64_t> numbers, kinds;
  std::vector<double> orientation, velocity, spin, momentum, force, torque, limit;
  for (const int number : which) {
    const auto k = static_cast<std::size_t>(number);
    const Grain& grain = checkpoint.grains[k];
    numbers.push_back(number);
    kinds.push_back(grain.kind);
    append(orientation, grain.orientation);
    append(velocity, grain.velocity);
    append(spin, grain.spin);
    append(momentum, checkpoint.angular_momentum[k]);
    append(force, checkpoint.force[k]);
    append(torque, checkpoint.torque[k]);
    limit.push_back(checkpoint.rolling_limit[k]);
  }
  arrays.integers("grain", 1, std::move(numbers));
  arrays.integers("kind", 1, std::move(kinds));
  arrays.numbers("orientation", 4, std::move(orientation));
  arrays.numbers("velocity", 3, std::move(velocity));
  arrays.numbers("spin", 3, std::move(spin));
  arrays.numbers("angular_momentum", 3, std::move(momentum));
  arrays.numbers("force", 3, std::move(force));
  arrays.numbers("torque", 3, std::move(torque));
  arrays.numbers("rolling_limit", 1, std::move(limit));
}

std::vector<double> positions_of(const Checkpoint& checkpoint, const std::vector<int>& which) {
  std::vector<double> positions;
  for (const int k : which)
    append(positions, checkpoint.grains[static_cast<std::size_t>(k)].position);
  return positions;
}

/// Fills in these grains in a checkpoint sized for all.
void take_grains(const ArrayReader& arrays, NumberStream position, std::size_t kinds, bool present,
                 Checkpoint& checkpoint, std::vector<bool>& is_filled) {
  IntegerStream number = arrays.integers("grain", 1), kind = arrays.integers("kind", 1);
  NumberStream orientation = arrays.numbers("orientation", 4);
  NumberStream velocity = arrays.numbers("velocity", 3), spin = arrays.numbers("spin", 3);
  NumberStream momentum = arrays.numbers("angular_momentum", 3);
  NumberStream force = arrays.numbers("force", 3), torque = arrays.numbers("torque", 3);
  NumberStream limit = arrays.numbers("rolling_limit", 1);
  while (!number.is_at_end()) {
    const auto k = static_cast<std::size_t>(take_index(number, checkpoint.grains.size()));
    if (is_filled[k]) {
      throw base::InputError({.value = fmt::format("array {} holds {} twice", number.name(), k)});
    }
    is_filled[k] = true;
    Grain& grain = checkpoint.grains[k];
    grain.kind = take_index(kind, kinds);
    grain.position = take_vector(position);
    grain.orientation = take_quaternion(orientation);
    grain.velocity = take_vector(velocity);
    grain.spin = take_vector(spin);
    checkpoint.angular_momentum[k] = take_vector(momentum);
    checkpoint.force[k] = take_vector(force);
    checkpoint.torque[k] = take_vector(torque);
    checkpoint.rolling_limit[k] = limit.take();
    checkpoint.is_present[k] = present;
  }
}

void add_contacts(ArrayWriter& arrays, const std::vector<ContactState>& contacts) {
  std::vector<std::int64_t> parts;
  std::vector<double> values, pushes;
  for (const ContactState& contact : contacts) {
    parts.insert(parts.end(),
                 {contact.grain_a, contact.sphere_a, contact.grain_b, contact.sphere_b});
    values.push_back(contact.contact_radius_m);
    append(values, contact.tangential_n);
    append(values, contact.rolling_n_m);
    pushes.push_back(contact.normal_force_n);
  }
  arrays.integers("contact_grain_sphere", 4, std::move(parts));
  arrays.numbers("contact_radius_tangential_rolling", kContactNumbers, std::move(values));
  arrays.numbers(kPush, 1, std::move(pushes));
}

/// Number of a sphere within its grain.
int take_sphere(IntegerStream& integers, const Checkpoint& checkpoint, int grain,
                const SimulationSetup& setup) {
  const int kind = checkpoint.grains[static_cast<std::size_t>(grain)].kind;
  return take_index(integers, setup.kinds[static_cast<std::size_t>(kind)].shape.spheres.size());
}

/// Grains from 0, walls as -1, -2, ...
int take_partner(IntegerStream& integers, std::size_t grains, std::size_t walls) {
  const std::int64_t number = integers.take();
  const bool is_known =
      number >= 0 ? std::cmp_less(number, grains) : std::cmp_less(-(number + 1), walls);
  if (!is_known) {
    throw base::InputError(
        {.value = fmt::format("array {} holds {}, which is neither a grain nor a wall",
                              integers.name(), number)});
  }
  return static_cast<int>(number);
}

/// Absent in states from before version 3.
void take_pushes(NumberStream pushes, std::vector<ContactState>& contacts) {
  for (ContactState& contact : contacts) contact.normal_force_n = pushes.take();
  check_end(pushes.is_at_end(), pushes.name());
}

std::vector<ContactState> contacts_in(const ArrayReader& arrays, const Checkpoint& checkpoint,
                                      const SimulationSetup& setup) {
  IntegerStream parts = arrays.integers("contact_grain_sphere", 4);
  NumberStream values = arrays.numbers("contact_radius_tangential_rolling", kContactNumbers);
  std::vector<ContactState> contacts;
  while (!parts.is_at_end()) {
    ContactState contact;
    contact.grain_a = take_index(parts, checkpoint.grains.size());
    contact.sphere_a = take_sphere(parts, checkpoint, contact.grain_a, setup);
    contact.grain_b = take_partner(parts, checkpoint.grains.size(), setup.walls.size());
    contact.sphere_b = contact.grain_b >= 0 ? take_sphere(parts, checkpoint, contact.grain_b, setup)
                                            : take_index(parts, std::numeric_limits<int>::max());
    contact.contact_radius_m = values.take();
    contact.tangential_n = take_vector(values);
    contact.rolling_n_m = take_vector(values);
    contacts.push_back(contact);
  }
  check_end(values.is_at_end(), values.name());
  if (arrays.has(kPush)) take_pushes(arrays.numbers(kPush, 1), contacts);
  return contacts;
}

/// Absent in states from before version 7, whose steps were all equally long.
EqualSteps equal_steps_in(const ArrayReader& fields, std::int64_t step) {
  const EqualSteps equal = {.since_step = fields.integers(kEqualSince, 1).take(),
                            .since_s = fields.numbers(kEqualSince_s, 1).take()};
  if (equal.since_step >= 0 && equal.since_step <= step && equal.since_s >= 0) return equal;
  throw base::InputError(
      {.value = fmt::format(
           "arrays {} and {} hold {} and {:g}, must be from 0 to the step, {}, and 0 or more",
           kEqualSince, kEqualSince_s, equal.since_step, equal.since_s, step)});
}

Checkpoint with_room_for(std::size_t grains) {
  Checkpoint checkpoint;
  checkpoint.grains.resize(grains);
  for (auto* field : {&checkpoint.angular_momentum, &checkpoint.force, &checkpoint.torque}) {
    field->resize(grains);
  }
  checkpoint.rolling_limit.resize(grains);
  checkpoint.is_present.resize(grains);
  return checkpoint;
}

}  // namespace

void add_checkpoint(const Checkpoint& checkpoint, const Simulation& simulation, VtkPoints& points,
                    ArrayWriter& fields) {
  const std::vector<int> present = grains_that_are(true, checkpoint);
  const std::vector<int> absent = grains_that_are(false, checkpoint);
  points.positions = positions_of(checkpoint, present);
  std::vector<double> masses;
  for (const int k : present) masses.push_back(simulation.mass_kg(k));
  ArrayWriter of_points;
  add_grains(of_points, checkpoint, present);
  of_points.numbers("mass", 1, std::move(masses));
  points.point_arrays = of_points.take();

  ArrayWriter of_absent(kAbsent);
  of_absent.numbers("position", 3, positions_of(checkpoint, absent));
  add_grains(of_absent, checkpoint, absent);
  fields.add(of_absent.take());
  add_contacts(fields, checkpoint.contacts);
  fields.integers("step", 1, {checkpoint.step});
  fields.integers(kEqualSince, 1, {checkpoint.equal_steps.since_step});
  fields.numbers(kEqualSince_s, 1, {checkpoint.equal_steps.since_s});
}

Checkpoint checkpoint_in(const VtkPoints& points, const SimulationSetup& setup) {
  const ArrayReader fields(points.field_arrays);
  const ArrayReader absent(points.field_arrays, kAbsent);
  const std::size_t grains = points.positions.size() / 3 + absent.integers("grain", 1).left();
  Checkpoint checkpoint = with_room_for(grains);
  std::vector<bool> is_filled(grains, false);
  const std::size_t kinds = setup.kinds.size();
  take_grains(ArrayReader(points.point_arrays), {"position", points.positions}, kinds, true,
              checkpoint, is_filled);
  take_grains(absent, absent.numbers("position", 3), kinds, false, checkpoint, is_filled);
  checkpoint.contacts = contacts_in(fields, checkpoint, setup);
  checkpoint.step = fields.integers("step", 1).take();
  if (checkpoint.step < 0) throw base::InputError({.value = "array step is below 0"});
  if (fields.has(kEqualSince)) checkpoint.equal_steps = equal_steps_in(fields, checkpoint.step);
  return checkpoint;
}

}  // namespace repose::dem
