#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dem/contact/contact_table.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/vector.h"
#include "dem/wall/wall.h"

namespace repose::dem {

/// A kind of grain: shape and material.
struct GrainKind {
  ClumpShape shape;
  int material = 0;
};

/// One grain's state. Spin in world axes.
struct Grain {
  int kind = 0;
  Vector position = Vector::Zero();  ///< of the centre of mass, m
  Quaternion orientation = Quaternion::Identity();
  Vector velocity = Vector::Zero();  ///< m/s
  Vector spin = Vector::Zero();      ///< rad/s
};

struct SimulationSetup {
  std::vector<GrainKind> kinds;
  std::vector<Wall> walls;
  ContactTable contacts;
  Vector gravity = {0, 0, -kStandardGravity_m_s2};
  double timestep_s = 0;
  int threads = 1;
  /// Grains whose centre falls below this height leave the simulation, m.
  double floor_m = -1e300;
  /// Steps between two audits of energy, time step and overlap; deep contacts are seen at once.
  int audit_steps = 500;
};

/// The sums that tell how a run is doing.
struct Energies {
  double kinetic_j = 0;    ///< of translation and spin
  double potential_j = 0;  ///< of gravity, from z = 0
  double elastic_j = 0;    ///< in the normal and tangential springs

  double sum_j() const { return kinetic_j + potential_j + elastic_j; }
};

/// One touching pair of spheres, or of a sphere and a wall.
struct ContactState {
  int grain_a = 0;
  int sphere_a = 0;                      ///< within the grain
  int grain_b = 0;                       ///< -1 - wall for a wall
  int sphere_b = 0;                      ///< facet of a wall
  double contact_radius_m = 0;           ///< at the last step
  Vector tangential_n = Vector::Zero();  ///< spring force on a
  Vector rolling_n_m = Vector::Zero();   ///< rolling spring's torque on a
  double normal_force_n = 0;             ///< normal force of the last step
};

/// Since when all steps are as long as they are now.
struct EqualSteps {
  std::int64_t since_step = 0;
  double since_s = 0;

  double time_s(std::int64_t step, double timestep_s) const {
    return since_s + static_cast<double>(step - since_step) * timestep_s;
  }
};

/// All that a run needs to go on bit for bit.
struct Checkpoint {
  std::int64_t step = 0;
  EqualSteps equal_steps = {};
  std::vector<Grain> grains;
  std::vector<Vector> angular_momentum;  ///< kg m^2/s; `Grain::spin` follows from it
  std::vector<Vector> force;             ///< of the last step, N
  std::vector<Vector> torque;            ///< of the last step, N m
  std::vector<double> rolling_limit;     ///< torque that rolling friction may take, N m
  std::vector<bool> is_present;
  std::vector<ContactState> contacts;
};

/// Rigid grains and walls in contact, moved step by step.
///
/// Equations and sources: dem/THEORY.md. The same setup and grains give the same bytes at any
/// number of threads. Not to be used from two threads at once.
class Simulation {
 public:
  /// Throws base::InputError when the setup cannot be simulated.
  explicit Simulation(SimulationSetup setup);
  Simulation(SimulationSetup setup, const Checkpoint& from);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Adds a grain and returns its number.
  int add(const Grain& grain);
  /// Takes a grain out; its number stays its own.
  void remove(int grain);
  /// Sets a wall in motion from now on, or to rest with an empty list. Times are of the simulation.
  void set_motions(int wall, std::vector<Motion> motions);
  /// Takes a wall out.
  void remove_wall(int wall);

  /// Of all steps from now on, s. Throws base::InputError unless it is above 0.
  void set_timestep(double timestep_s);

  /// Throws UnstableRun when the audit finds the run gone wrong.
  void advance(std::int64_t steps);

  /// Of now: its walls move as they were last told to, its time step is that of the next step.
  const SimulationSetup& setup() const;
  std::int64_t step() const;
  double time_s() const;
  int grain_count() const;  ///< of all ever added
  bool is_present(int grain) const;
  Grain grain(int grain) const;
  double mass_kg(int grain) const;
  Vector force_n(int grain) const;  ///< of contacts and gravity
  Vector torque_n_m(int grain) const;
  WallMoment wall(int wall) const;
  Energies energies() const;
  std::vector<ContactState> contacts() const;
  /// Deepest overlap at the last step, as a fraction of the smaller sphere's radius.
  double deepest_overlap() const;
  /// Largest time step that is stable for the contacts there are now, s; none without contacts.
  std::optional<double> stable_timestep_s() const;
  Checkpoint checkpoint() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace repose::dem
