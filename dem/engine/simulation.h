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
  /// Steps between audits of energy, time step and overlap; deep contacts are caught at once.
  int audit_steps = 500;
};

/// Total energies, which show whether a run is healthy.
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
  int grain_b = 0;                       ///< -1 - wall number for a wall
  int sphere_b = 0;                      ///< facet of a wall
  double contact_radius_m = 0;           ///< at the last step
  Vector tangential_n = Vector::Zero();  ///< spring force on a
  Vector rolling_n_m = Vector::Zero();   ///< rolling spring's torque on a
  double normal_force_n = 0;             ///< normal force of the last step
};

/// Since when the time step has had its current length.
struct EqualSteps {
  std::int64_t since_step = 0;
  double since_s = 0;

  double time_s(std::int64_t step, double timestep_s) const {
    return since_s + static_cast<double>(step - since_step) * timestep_s;
  }
};

/// All that a run needs to resume bit for bit.
struct Checkpoint {
  std::int64_t step = 0;
  EqualSteps equal_steps = {};
  std::vector<Grain> grains;
  std::vector<Vector> angular_momentum;  ///< kg m^2/s; `Grain::spin` follows from it
  std::vector<Vector> force;             ///< of the last step, N
  std::vector<Vector> torque;            ///< of the last step, N m
  std::vector<double>
      rolling_limit;  ///< most that constant-torque rolling friction can resist, N m
  std::vector<bool> is_present;
  std::vector<ContactState> contacts;
};

/// Rigid grains and walls in contact, moved step by step.
///
/// Equations and sources: dem/THEORY.md. The same setup and grains give identical results with any
/// number of threads. Not thread-safe.
class Simulation {
 public:
  /// Throws base::InputError if the setup cannot be simulated.
  explicit Simulation(SimulationSetup setup);
  Simulation(SimulationSetup setup, const Checkpoint& from);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Adds a grain and returns its number.
  int add(const Grain& grain);
  /// Removes a grain; its number is not reused.
  void remove(int grain);
  /// Sets a wall in motion from now on, or at rest with an empty list. Times are simulation times.
  void set_motions(int wall, std::vector<Motion> motions);
  /// Removes a wall.
  void remove_wall(int wall);

  /// Sets the length of all steps from now on, s. Throws base::InputError unless above 0.
  void set_timestep(double timestep_s);

  /// Throws UnstableRun if the audit finds that the run has gone wrong.
  void advance(std::int64_t steps);

  /// The current setup: walls carry their latest motion, the time step is that of the next step.
  const SimulationSetup& setup() const;
  std::int64_t step() const;
  double time_s() const;
  int grain_count() const;  ///< all ever added
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
  /// Largest stable time step for the current contacts, s; std::nullopt without contacts.
  std::optional<double> stable_timestep_s() const;
  Checkpoint checkpoint() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace repose::dem
