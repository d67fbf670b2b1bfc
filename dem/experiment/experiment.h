#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "dem/contact/material.h"
#include "dem/engine/simulation.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/protocol.h"
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

/// What goes on in a heap experiment, in this order.
enum class HeapStage { rain, settle_in_tube, lift, settle };

/// Where a heap experiment stands: with the state of its simulation all that it needs to go on.
struct HeapProgress {
  HeapStage stage = HeapStage::rain;
  Work work = {};
  std::int64_t steps_left = 0;     ///< of the stretch between two looks that is under way
  std::uint64_t random_draws = 0;  ///< taken so far by the rain
  RestMemory rest = {};            ///< of the settling under way
  double until_s = 0;              ///< when that settling ends at the latest
  int grains = 0;                  ///< when the lift began
  double start_m = 0;              ///< how high they lay then
};

/// A heap experiment interrupted on its way.
struct HeapRestart {
  SimulationSetup setup;
  Checkpoint checkpoint;
  HeapProgress progress;
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

/// One repeat of an experiment, as the engine gives it.
struct Repeat {
  std::uint64_t seed = 0;
  /// In the unit of the experiment; none of a heap: its `envelopes` are measured, not here.
  std::optional<double> value;
  Readings readings;  ///< others than the value
  std::int64_t steps = 0;
  double timestep_s = 0;                     ///< the shortest
  double clump_steps = 0;                    ///< grains times steps, summed
  std::vector<HeapEnvelope> envelopes = {};  ///< of a heap, from 18 sides; else empty
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
  /// Heaps only, the others are shorter: is handed what resume_heap() needs, whenever
  /// `is_restart_due` says so, which is asked every some million grain steps, and when the run is
  /// interrupted.
  std::function<void(const Simulation&, const HeapProgress&)> save_restart;
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

// Each runs one repeat. The same seed gives the same bytes at any number of threads. They throw
// base::InputError for a protocol that cannot be run (every error at once), UnstableRun for a
// run that went wrong, NoMeasurement and Interrupted as said there.
Repeat run_drop(const Model& model, const DropProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});
Repeat run_tilt(const Model& model, const TiltProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});
Repeat run_roll(const Model& model, const RollProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});
Repeat run_heap(const Model& model, const HeapProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});
Repeat run_drop_on_grains(const Model& model, const GrainDropProtocol& protocol, std::uint64_t seed,
                          const ProgressReport& report = {}, const RunRecord& record = {});
Repeat run_tilt_on_grains(const Model& model, const GrainTiltProtocol& protocol, std::uint64_t seed,
                          const ProgressReport& report = {}, const RunRecord& record = {});
Repeat run_roll_on_grains(const Model& model, const GrainRollProtocol& protocol, std::uint64_t seed,
                          const ProgressReport& report = {}, const RunRecord& record = {});

Repeat run_fill(const Model& model, const FillProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});
Repeat run_pendulum(const Model& model, const PendulumProtocol& protocol, std::uint64_t seed,
                    const ProgressReport& report = {}, const RunRecord& record = {});
Repeat run_draw_down(const Model& model, const DrawDownProtocol& protocol, std::uint64_t seed,
                     const ProgressReport& report = {}, const RunRecord& record = {});

/// Goes on with a heap that was interrupted, to the same bytes as one that was not. `from` must be
/// of the same bench, protocol and seed, which is not checked.
Repeat resume_heap(const Model& model, const HeapProtocol& protocol, std::uint64_t seed,
                   const HeapRestart& from, const ProgressReport& report = {},
                   const RunRecord& record = {});

}  // namespace repose::dem
