#pragma once

#include <any>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "dem/contact/material.h"
#include "dem/engine/simulation.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/vector.h"

namespace repose::dem {

/// Computing effort of a run so far.
struct Work {
  std::int64_t steps = 0;
  double clump_steps = 0;
  double shortest_timestep_s = 1e300;  ///< initially, without steps
};

/// State of a rest test between looks.
struct RestMemory {
  double since_s = 0;          ///< when the current window began
  std::vector<Vector> before;  ///< the centres then; empty before the first look
};

/// Progress of a run: with the state of its simulation, all that is needed to resume it. Each
/// experiment uses the fields it needs.
struct RunProgress {
  int stage = 0;  ///< of the experiment's stages, ExperimentEntry::stages
  Work work = {};
  std::int64_t steps_left = 0;     ///< in the current stretch between two looks
  std::uint64_t random_draws = 0;  ///< taken so far
  RestMemory rest = {};            ///< of the current settling
  double until_s = 0;              ///< latest end of that settling
  int grains = 0;                  ///< number when the lift begins
  double start_m = 0;              ///< height of the highest point then
};

/// An interrupted run.
struct Restart {
  SimulationSetup setup;
  Checkpoint checkpoint;
  RunProgress progress;
};

/// What all experiments share: grain, materials, coefficients, numerical settings.
struct Model {
  ClumpShape grain;
  /// Standard deviation of the grains' sizes in bulks, as a fraction of their mean (see
  /// size_classes()); 0: all equal. Single grains, on a plate or glued, have the mean size.
  double size_cv = 0;
  Material grain_material;
  Material wall_material;  ///< of the plate, and of all parts not in `parts`
  PairCoefficients grain_wall;
  WallSurfaces parts = {};
  PairCoefficients grain_grain;
  RollingModel rolling = RollingModel::constant_torque;
  DampingModel damping = DampingModel::per_contact;
  /// All Young's moduli are multiplied by this: 1 is the real material. Softening shortens runs and
  /// changes results, so each result states it.
  double stiffness_factor = 1;
  /// Time step as a fraction of the longest accurate one; see time_step.h.
  double timestep_fraction = 1;
  /// Overrides the engine's choice, s. Rejected if not safe.
  std::optional<double> timestep_s;
  int threads = 1;
};

/// Readings of a run, named with their unit: "lowest_point_rise_mm", "grains_off_plate". A reading
/// that could not be taken is listed without a number.
struct Readings : std::map<std::string, std::optional<double>> {
  using map::map;
  /// std::nullopt also if the name is not listed.
  std::optional<double> number(const std::string& name) const;
  /// @throws std::out_of_range  there is no such number.
  double at(const std::string& name) const;
};

/// The upper outline of what lies on the ground, in a level view from one side: the highest point
/// of the grains in each vertical column of the image plane.
struct Envelope {
  double azimuth_rad = 0;        ///< 0 looks along +y; counter-clockwise seen from above
  double column_m = 0;           ///< from one column to the next
  std::vector<double> height_m;  ///< of the columns above the ground, left to right; all above 0
};

/// One repeat of an experiment, as produced by the engine.
struct Repeat {
  std::uint64_t seed = 0;
  /// In the unit of the experiment; std::nullopt if it is to be measured from `envelopes`, which is
  /// not done here.
  std::optional<double> value;
  Readings readings;  ///< other than the value
  std::int64_t steps = 0;
  double timestep_s = 0;   ///< the shortest
  double clump_steps = 0;  ///< grains times steps, summed
  /// From all sides, for an experiment whose value is their angle; otherwise empty.
  std::vector<Envelope> envelopes = {};
  /// Final state, for viewing; shared because a simulation cannot be copied. Null if the run was
  /// read from a file.
  std::shared_ptr<const Simulation> state = nullptr;
};

/// Called periodically with the completed fraction (0 ... 1); returns false to cancel the run.
using ProgressReport = std::function<bool(double fraction, const Simulation&)>;

/// Optional outputs of a run besides its progress reports.
struct RunRecord {
  /// Called with each simulation of the run at its start, then at the first steps at or after
  /// multiples of `frame_interval_s` (above 0) of simulation time.
  std::function<void(const Simulation&)> frame;
  double frame_interval_s = 0;
  /// Called with what ExperimentEntry::resume needs when the run is interrupted and whenever
  /// `is_restart_due` returns true, which is checked about every million grain steps and at
  /// progress reports.
  std::function<void(const Simulation&, const RunProgress&)> save_restart;
  std::function<bool()> is_restart_due;
};

/// Thrown when a ProgressReport cancels the run.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown when the experiment ran but what it measures did not happen: says what happened instead.
class NoMeasurement : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// States what a coefficient of restitution means for the model's clump, and at which speed.
std::string damping_definition(const Model& model);

template <typename Kind>
concept KindOfProtocol = std::is_aggregate_v<Kind> && std::is_copy_constructible_v<Kind>;

/// How an experiment is done: any one protocol, such as a DropProtocol.
///
/// Each experiment has a run_NAME(), which runs one repeat of its protocol. The same seed gives
/// identical results with any number of threads. They throw base::InputError for an invalid
/// protocol (all errors at once), UnstableRun if the run went wrong, NoMeasurement and Interrupted
/// as described there.
class Protocol {
 public:
  Protocol() = default;  ///< belongs to no experiment
  /// Belongs to the experiment with this protocol type.
  template <KindOfProtocol Kind>
  // NOLINTNEXTLINE(google-explicit-constructor): a protocol of one experiment is a protocol
  Protocol(Kind kind) : kind_(std::move(kind)) {}

  /// The protocol itself. @throws std::bad_any_cast  it is of another type.
  template <typename Kind>
  const Kind& as() const {
    return std::any_cast<const Kind&>(kind_);
  }
  template <typename Kind>
  Kind& as() {
    return std::any_cast<Kind&>(kind_);
  }

  const std::type_info& kind() const { return kind_.type(); }

 private:
  std::any kind_;
};

}  // namespace repose::dem
