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

/// What a run has cost so far.
struct Work {
  std::int64_t steps = 0;
  double clump_steps = 0;
  double shortest_timestep_s = 1e300;  ///< as long as there are no steps
};

/// What a rest test remembers from one look to the next.
struct RestMemory {
  double since_s = 0;          ///< when the window at hand began
  std::vector<Vector> before;  ///< the centres then; empty before the first look
};

/// Where a run stands: with the state of its simulation all that it needs to go on. Each experiment
/// uses what it needs of it.
struct RunProgress {
  int stage = 0;  ///< of the experiment's stages, ExperimentEntry::stages
  Work work = {};
  std::int64_t steps_left = 0;     ///< of the stretch between two looks that is under way
  std::uint64_t random_draws = 0;  ///< taken so far
  RestMemory rest = {};            ///< of the settling under way
  double until_s = 0;              ///< when that settling ends at the latest
  int grains = 0;                  ///< when those that were filled in are set free
  double start_m = 0;              ///< how high they lay then
};

/// A run interrupted on its way.
struct Restart {
  SimulationSetup setup;
  Checkpoint checkpoint;
  RunProgress progress;
};

/// What all experiments share: grain, materials, coefficients, and how to compute.
struct Model {
  ClumpShape grain;
  /// Standard deviation of the grains' sizes in bulks, as a fraction of their mean
  /// (size_classes.h); 0: all are alike. Grains that are alone, on a plate or glued, have the mean
  /// size.
  double size_cv = 0;
  Material grain_material;
  Material wall_material;  ///< of the plate, and of all parts that `parts` does not name
  PairCoefficients grain_wall;
  WallSurfaces parts = {};
  PairCoefficients grain_grain;
  RollingModel rolling = RollingModel::constant_torque;
  DampingModel damping = DampingModel::per_contact;
  /// Both Young's moduli are multiplied by this: 1 is the real material. Softening shortens runs
  /// and changes results: stated with each.
  double stiffness_factor = 1;
  /// Time step as a fraction of the longest that is accurate; see time_step.h.
  double timestep_fraction = 1;
  /// Instead of the engine's choice, s. Refused when it is not safe.
  std::optional<double> timestep_s;
  int threads = 1;
};

/// Readings of a run, named with their unit: "lowest_point_rise_mm", "grains_off_plate". One that
/// could not be taken is among them, without a number.
struct Readings : std::map<std::string, std::optional<double>> {
  using map::map;
  /// None also for a name that is not among them.
  std::optional<double> number(const std::string& name) const;
  /// @throws std::out_of_range  there is no such number.
  double at(const std::string& name) const;
};

/// The upper edge of what lies on the ground, seen level from one side: the highest point of its
/// grains in each upright column of the picture plane.
struct Envelope {
  double azimuth_rad = 0;        ///< 0 looks along +y; rises counter-clockwise, seen from above
  double column_m = 0;           ///< from one column to the next
  std::vector<double> height_m;  ///< of the columns above the ground, left to right; all above 0
};

/// One repeat of an experiment, as the engine gives it.
struct Repeat {
  std::uint64_t seed = 0;
  /// In the unit of the experiment; none where `envelopes` are to be measured, which is not done
  /// here.
  std::optional<double> value;
  Readings readings;  ///< others than the value
  std::int64_t steps = 0;
  double timestep_s = 0;   ///< the shortest
  double clump_steps = 0;  ///< grains times steps, summed
  /// From all sides, of an experiment whose value is an angle of them; else empty.
  std::vector<Envelope> envelopes = {};
  /// The end of the run, to look at; shared because a simulation cannot be copied. Null: of a run
  /// that was read from a file.
  std::shared_ptr<const Simulation> state = nullptr;
};

/// Called periodically with the completed fraction (0 ... 1); returns false to cancel the run.
using ProgressReport = std::function<bool(double fraction, const Simulation&)>;

/// What a run hands out on its way, beside its reports; each may be left out.
struct RunRecord {
  /// Is shown each simulation of the run at its beginning, and then at the first steps at or after
  /// the multiples of `frame_interval_s` (above 0) of its time.
  std::function<void(const Simulation&)> frame;
  double frame_interval_s = 0;
  /// Is handed what ExperimentEntry::resume needs, whenever `is_restart_due` says so, which is
  /// asked every some million grain steps, and when the run is interrupted.
  std::function<void(const Simulation&, const RunProgress&)> save_restart;
  std::function<bool()> is_restart_due;
};

/// Thrown when a ProgressReport asked for it.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown when the experiment ran and what it measures did not happen: says what happened instead.
class NoMeasurement : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a coefficient of restitution means for the model's clump, and at which speed.
std::string damping_definition(const Model& model);

template <typename Kind>
concept KindOfProtocol = std::is_aggregate_v<Kind> && std::is_copy_constructible_v<Kind>;

/// How an experiment is done: the protocol of one of them, such as a DropProtocol.
///
/// Each experiment has a run_NAME(), which runs one repeat by its protocol. The same seed gives the
/// same bytes at any number of threads. They throw base::InputError for a protocol that cannot be
/// run (every error at once), UnstableRun for a run that went wrong, NoMeasurement and Interrupted
/// as said there.
class Protocol {
 public:
  Protocol() = default;  ///< of no experiment
  /// Of the experiment that has this kind of protocol.
  template <KindOfProtocol Kind>
  // NOLINTNEXTLINE(google-explicit-constructor): a protocol of one experiment is a protocol
  Protocol(Kind kind) : kind_(std::move(kind)) {}

  /// The protocol itself. @throws std::bad_any_cast  it is of another kind.
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
