#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "dem/engine/simulation.h"

namespace repose::dem {

/// A grain at the end of a step.
struct PathPoint {
  double time_s = 0;
  Grain grain = {};
};
using Path = std::vector<PathPoint>;

/// One grain about to strike something, or two about to meet, from above and below.
using Meeting = std::vector<Grain>;

/// A collision sampled at the ends of its steps.
struct CollisionSamples {
  double timestep_s = 0;
  std::vector<double> overlaps_m;  ///< the deepest contact's; the first and the last are 0
  std::vector<double> pushes_n;    ///< on grain 0, upwards
};

/// Outcome of the contact of grain 0.
struct Collision {
  Grain after;
  Grain struck;  ///< grain 1 afterwards, if there is one
  double deepest_m = 0;
  double peak_n = 0;  ///< greatest upward force
  double pull_n = 0;  ///< greatest downward force; 0 if never downward
  double duration_s = 0;
};

/// Peaks and duration, interpolated between steps.
/// @pre overlap is above 0 at two steps or more
Collision collision_of(const CollisionSamples& samples, const Grain& after, const Grain& struck);

/// Thrown if a program cannot run a case; the message states what is lacking.
class CannotRun : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Another program that runs cases of `repose verify`.
class CasePeer {
 public:
  CasePeer() = default;
  virtual ~CasePeer() = default;
  CasePeer(const CasePeer&) = delete;
  CasePeer& operator=(const CasePeer&) = delete;
  CasePeer(CasePeer&&) = delete;
  CasePeer& operator=(CasePeer&&) = delete;

  /// For display: "LIGGGHTS-PUBLIC 3.8.0".
  virtual std::string title() const = 0;
  /// As Trial::collide_each, with the time step of `setup`.
  /// @throws CannotRun
  /// @throws base::InputError  it failed.
  virtual std::vector<Collision> collide_each(const SimulationSetup& setup,
                                              const std::vector<Meeting>& meetings) const = 0;
  /// As Trial::follow, with the time step of `setup`.
  virtual Path follow(const SimulationSetup& setup, const std::vector<Grain>& grains,
                      double duration_s, int every_steps) const = 0;
  /// For display: values of a scene that the program replaces, and by which; empty: none.
  virtual std::string changes_to(const SimulationSetup& /*setup*/) const { return {}; }
};

}  // namespace repose::dem
