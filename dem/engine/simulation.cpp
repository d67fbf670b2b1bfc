#include "dem/engine/simulation.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include "base/input_error.h"
#include "dem/engine/audit.h"
#include "dem/engine/bodies.h"
#include "dem/engine/interactions.h"
#include "dem/engine/neighbour_list.h"
#include "dem/engine/parallel.h"
#include "dem/engine/unstable_run.h"

namespace repose::dem {
namespace {

/// Steps up to this fraction of the stable one are not to blame for deep contacts.
constexpr double kShortStep = .5;
/// Energy that may appear between two audits, as a fraction of kinetic and elastic energy plus that
/// of a fall by a grain's size.
constexpr double kEnergyTolerance = .05;

bool is_time(double timestep_s) { return timestep_s > 0 && std::isfinite(timestep_s); }

base::Fault timestep_error(double timestep_s) {
  return {.subject = "timestep_s", .value = fmt::format("is {:g}", timestep_s), .rule = "above 0"};
}

SimulationSetup checked(SimulationSetup setup) {
  base::Faults faults;
  faults.require(is_time(setup.timestep_s), timestep_error(setup.timestep_s));
  faults.require(
      setup.threads >= 1,
      {.subject = "threads", .value = fmt::format("is {}", setup.threads), .rule = "1 or more"});
  faults.require(setup.audit_steps >= 1, {.subject = "audit_steps",
                                          .value = fmt::format("is {}", setup.audit_steps),
                                          .rule = "1 or more"});
  const auto is_known = [&setup](int material) {
    return material >= 0 && material < setup.contacts.size();
  };
  for (std::size_t k = 0; k < setup.kinds.size(); ++k) {
    const ClumpShape& shape = setup.kinds[k].shape;
    const auto require = [&](bool holds, const char* what) {
      faults.require(holds, {.where = fmt::format("grain kind {}", k), .value = what});
    };
    require(is_known(setup.kinds[k].material), "no such material");
    require(!shape.spheres.empty(), "it has no spheres");
    require(shape.volume_m3 > 0 && shape.gyration_m2.minCoeff() > 0,
            "volume and moments of inertia must be above 0");
    for (const ClumpSphere& sphere : shape.spheres) {
      require(sphere.radius > 0, "a radius is not above 0");
    }
  }
  for (std::size_t k = 0; k < setup.walls.size(); ++k) {
    faults.require(is_known(setup.walls[k].material),
                   {.where = fmt::format("wall {}", k), .value = "no such material"});
  }
  faults.throw_if_any();
  return setup;
}

}  // namespace

class Simulation::State {
 public:
  explicit State(SimulationSetup given)
      : setup(checked(std::move(given))), walls(setup.walls), arena(setup.threads) {}

  /// Throws std::out_of_range if there is no such grain.
  std::size_t index(int grain) const;
  double time_s() const { return equal_steps.time_s(step, setup.timestep_s); }
  ContactStep contact_step() const { return {bodies, walls, setup.contacts, setup.timestep_s}; }

  void take_step();
  void leave_through_floor();
  void audit();
  void audit_contacts();
  void audit_overlap_at_rest();
  void audit_energy();
  [[noreturn]] void stop(const std::string& what, const std::string& fix) const;
  /// After energy jumps not caused by the dynamics: grains or walls added or removed.
  void restart_energy_audit() { has_energy_mark = false; }

  SimulationSetup setup;
  WallSet walls;
  tbb::task_arena arena;
  std::int64_t step = 0;
  EqualSteps equal_steps;
  Bodies bodies;
  Neighbours neighbours;
  Interactions interactions;
  ContactTally tally;
  OverlapWatch overlaps;
  bool has_energy_mark = false;
  double energy_mark_j = 0;
  double wall_work_j = 0;
};

std::size_t Simulation::State::index(int grain) const {
  const auto k = static_cast<std::size_t>(grain);
  if (k < bodies.size()) return k;
  throw std::out_of_range(fmt::format("grain {}: there are {}", grain, bodies.size()));
}

void Simulation::State::take_step() {
  const double timestep = setup.timestep_s;
  start_step(bodies, setup.kinds, setup.gravity, timestep, setup.threads);
  ++step;
  walls.move_to(time_s());
  neighbours.update(bodies, walls, time_s(), timestep, setup.threads);
  tally = interactions.apply(bodies, contact_step(), neighbours.list(), setup.threads);
  wall_work_j += tally.wall_power_w * timestep;
  finish_step(bodies, timestep, setup.threads);
  leave_through_floor();
}

void Simulation::State::leave_through_floor() {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies.is_present(k) || bodies.position[k].xyz.z() >= setup.floor_m) continue;
    bodies.presence[k] = 0;
    neighbours.forget_grain(static_cast<int>(k));
    restart_energy_audit();
  }
}

void Simulation::State::stop(const std::string& what, const std::string& fix) const {
  throw UnstableRun(
      fmt::format("the run was stopped at {:.6f} s (step {} of {:.3g} s): {}. "
                  "Fix: {}.",
                  time_s(), step, setup.timestep_s, what, fix));
}

/// At regular intervals.
void Simulation::State::audit() {
  audit_contacts();
  audit_overlap_at_rest();
  audit_energy();
}

/// At regular intervals, and when contacts become much deeper than before.
void Simulation::State::audit_contacts() {
  const auto frequency = highest_frequency(bodies, walls, setup.contacts, neighbours.list());
  const double step_of_stable = frequency ? setup.timestep_s * *frequency / 2 : 0;
  const double depth = tally.deepest_overlap;
  if (depth > OverlapWatch::kDeepest) {
    const int deepest = deepest_body(bodies, walls, setup.contacts, neighbours.list());
    const Vector at = bodies.position[index(deepest)].xyz;
    stop(fmt::format("grain {} at ({:.4f}, {:.4f}, {:.4f}) m overlaps by {:.0f} % of a radius",
                     deepest, at.x(), at.y(), at.z(), 100 * depth),
         step_of_stable > kShortStep ? "a shorter time step"
                                     : "a larger young_modulus_pa or stiffness_factor, or slower "
                                       "impacts");
  }
  if (step_of_stable >= 1) {
    stop(fmt::format("its contacts need a time step below {:.3g} s", 2 / *frequency),
         "a shorter time step, or slower impacts");
  }
}

void Simulation::State::audit_overlap_at_rest() {
  const double depth = overlaps.take_lasting();
  if (depth <= OverlapWatch::kDeepestAtRest) return;
  // By Hertz's law the weight that a contact carries grows with overlap^(3/2).
  const double stiffer = 2 * std::pow(depth / OverlapWatch::kDeepestAtRest, 1.5);
  stop(fmt::format("grain {} has sunk into what it lies on by {:.0f} % of a radius",
                   deepest_body(bodies, walls, setup.contacts, neighbours.list()), 100 * depth),
       fmt::format("a young_modulus_pa or stiffness_factor at least {:.2g} times as large",
                   stiffer));
}

void Simulation::State::audit_energy() {
  const auto& list = neighbours.list();
  const std::string fix = "a shorter time step, or slower impacts";
  const Energies now = energies_of(bodies, walls, setup.contacts, list, setup.gravity);
  if (!std::isfinite(now.sum_j())) stop("its energy is no number", fix);
  const double made = now.sum_j() - energy_mark_j - wall_work_j;
  double falls = 0;  // energy released by a fall by each grain's size
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (bodies.is_present(k))
      falls += bodies.mass[k] * setup.gravity.norm() * bodies.bounding_radius[k];
  }
  if (has_energy_mark && made > kEnergyTolerance * (now.kinetic_j + now.elastic_j + falls)) {
    stop(fmt::format("energy grew by {:.3g} J ({:.3g} J are in motion)", made, now.kinetic_j), fix);
  }
  has_energy_mark = true;
  energy_mark_j = now.sum_j();
  wall_work_j = 0;
}

Simulation::Simulation(SimulationSetup setup) : state_(std::make_unique<State>(std::move(setup))) {}

Simulation::Simulation(SimulationSetup setup, const Checkpoint& from)
    : Simulation(std::move(setup)) {
  const std::size_t count = from.grains.size();
  for (const std::size_t size :
       {from.angular_momentum.size(), from.force.size(), from.torque.size(),
        from.rolling_limit.size(), from.is_present.size()}) {
    if (size == count) continue;
    throw base::InputError(
        {.where = "checkpoint",
         .value =
             fmt::format("it has {} grains, but {} entries of one of their fields", count, size),
         .fix = "go on from a checkpoint that was not changed."});
  }
  State& s = *state_;
  for (const Grain& grain : from.grains) add(grain);
  s.step = from.step;
  s.equal_steps = from.equal_steps;
  s.walls.move_to(s.time_s());
  for (std::size_t k = 0; k < count; ++k) {
    s.bodies.angular_momentum.set(k, from.angular_momentum[k]);
    s.bodies.load[k] = {.force = {.xyz = from.force[k]},
                        .torque = {.xyz = from.torque[k], .w = from.rolling_limit[k]}};
    s.bodies.presence[k] = from.is_present[k] ? 1 : 0;
  }
  s.neighbours.update(s.bodies, s.walls, s.time_s(), s.setup.timestep_s, s.setup.threads);
  s.neighbours.restore(s.bodies, from.contacts);
  for (const ContactState& contact : from.contacts) {
    s.bodies.load[static_cast<std::size_t>(contact.grain_a)].force.w += 1;
    if (contact.grain_b >= 0) s.bodies.load[static_cast<std::size_t>(contact.grain_b)].force.w += 1;
  }
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

int Simulation::add(const Grain& grain) {
  State& s = *state_;
  if (grain.kind < 0 || static_cast<std::size_t>(grain.kind) >= s.setup.kinds.size()) {
    throw base::InputError({.value = fmt::format("grain kind {} does not exist", grain.kind)});
  }
  if (!grain.position.allFinite() || !grain.velocity.allFinite() || !grain.spin.allFinite() ||
      !(std::abs(grain.orientation.norm() - 1) < 1e-6)) {
    throw base::InputError({.where = fmt::format("grain {}", grain_count()),
                            .value = "position, velocity and spin",
                            .rule = "must be numbers, and the orientation a quaternion of length 1",
                            .fix = "check what placed it."});
  }
  const GrainKind& kind = s.setup.kinds[static_cast<std::size_t>(grain.kind)];
  add_body(s.bodies, grain, kind, s.setup.contacts.material(kind.material).density_kg_m3);
  s.bodies.load[s.bodies.size() - 1].force.xyz =
      s.bodies.mass[s.bodies.size() - 1] * s.setup.gravity;
  s.neighbours.expire();
  s.restart_energy_audit();
  return static_cast<int>(s.bodies.size()) - 1;
}

void Simulation::remove(int grain) {
  state_->bodies.presence[state_->index(grain)] = 0;
  state_->neighbours.forget_grain(grain);
  state_->restart_energy_audit();
}

void Simulation::set_motions(int wall, std::vector<Motion> motions) {
  State& s = *state_;
  s.walls.set_motions(wall, std::move(motions), s.time_s());
  s.setup.walls.at(static_cast<std::size_t>(wall)) = s.walls.wall(wall);
  s.neighbours.expire();
}

void Simulation::remove_wall(int wall) {
  state_->walls.remove(wall);
  state_->setup.walls.at(static_cast<std::size_t>(wall)).is_present = false;
  state_->neighbours.forget_wall(wall);
  state_->restart_energy_audit();
}

void Simulation::set_timestep(double timestep_s) {
  State& s = *state_;
  if (!is_time(timestep_s)) throw base::InputError(timestep_error(timestep_s));
  if (timestep_s == s.setup.timestep_s) return;
  s.equal_steps = {.since_step = s.step, .since_s = s.time_s()};
  s.setup.timestep_s = timestep_s;
  s.neighbours.look_up_again();
}

void Simulation::advance(std::int64_t steps) {
  State& s = *state_;
  s.arena.execute([&s, steps] {
    for (std::int64_t k = 0; k < steps; ++k) {
      s.take_step();
      if (s.overlaps.see(s.tally.deepest_overlap)) s.audit_contacts();
      if (s.step % s.setup.audit_steps == 0) s.audit();
    }
  });
}

const SimulationSetup& Simulation::setup() const { return state_->setup; }
std::int64_t Simulation::step() const { return state_->step; }
double Simulation::time_s() const { return state_->time_s(); }
int Simulation::grain_count() const { return static_cast<int>(state_->bodies.size()); }
bool Simulation::is_present(int grain) const {
  return state_->bodies.is_present(state_->index(grain));
}

Grain Simulation::grain(int grain) const {
  const Bodies& bodies = state_->bodies;
  const std::size_t k = state_->index(grain);
  return {.kind = bodies.kind[k],
          .position = bodies.position[k].xyz,
          .orientation = bodies.orientation_of(k),
          .velocity = bodies.velocity[k],
          .spin = bodies.spin_of(k)};
}

double Simulation::mass_kg(int grain) const { return state_->bodies.mass[state_->index(grain)]; }
Vector Simulation::force_n(int grain) const {
  return state_->bodies.load[state_->index(grain)].force.xyz;
}
Vector Simulation::torque_n_m(int grain) const {
  return state_->bodies.load[state_->index(grain)].torque.xyz;
}
WallMoment Simulation::wall(int wall) const { return state_->walls.moment(wall); }
double Simulation::deepest_overlap() const { return state_->tally.deepest_overlap; }

Energies Simulation::energies() const {
  const State& s = *state_;
  return energies_of(s.bodies, s.walls, s.setup.contacts, s.neighbours.list(), s.setup.gravity);
}

std::optional<double> Simulation::stable_timestep_s() const {
  const State& s = *state_;
  const auto frequency =
      highest_frequency(s.bodies, s.walls, s.setup.contacts, s.neighbours.list());
  if (!frequency) return std::nullopt;
  return 2 / *frequency;
}

std::vector<ContactState> Simulation::contacts() const {
  return state_->neighbours.touching(state_->bodies);
}

Checkpoint Simulation::checkpoint() const {
  const State& s = *state_;
  Checkpoint now;
  now.step = s.step;
  now.equal_steps = s.equal_steps;
  now.contacts = contacts();
  for (std::size_t k = 0; k < s.bodies.size(); ++k) {
    now.grains.push_back(grain(static_cast<int>(k)));
    now.angular_momentum.push_back(s.bodies.angular_momentum[k]);
    now.force.push_back(s.bodies.load[k].force.xyz);
    now.torque.push_back(s.bodies.load[k].torque.xyz);
    now.rolling_limit.push_back(s.bodies.load[k].torque.w);
    now.is_present.push_back(s.bodies.is_present(k));
  }
  return now;
}

}  // namespace repose::dem
