#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "dem/contact/material.h"
#include "dem/engine/simulation.h"
#include "dem/experiment/heap_envelope.h"
#include "dem/experiment/heap_progress.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// What all experiments share: grain, materials, coefficients, and how to compute.
struct Model {
  ClumpShape grain;
  Material grain_material;
  Material wall_material;
  PairCoefficients grain_wall;
  PairCoefficients grain_grain;
  RollingModel rolling = RollingModel::constant_torque;
  /// Both Young's moduli are multiplied by this: 1 is the real material. Softening shortens runs
  /// and changes results: stated with each.
  double stiffness_factor = 1;
  /// Time step as a fraction of the longest that is accurate; see time_step.h.
  double timestep_fraction = 1;
  /// Instead of the engine's choice, s. Refused when it is not safe.
  std::optional<double> timestep_s;
  int threads = 1;
};

/// Single grains dropped on a flat wall in random poses.
///
/// Value: how far the centroid rises from its lowest place during the bounce to the top of the
/// first flight after it, mm, mean of the grains; 0 for a grain that never leaves the wall. It is
/// what a camera sees. Readings: "above_first_touch_mm" (the same from the height of the centroid
/// at first touch: less, below 0 for a grain that topples), "lowest_point_rise_mm" (of the lowest
/// surface point over the wall at the top), "sd_mm" (scatter of the value between grains),
/// "never_rose" (how many).
struct DropProtocol {
  double height_m = .5;  ///< of the lowest point above the wall
  int grains = 10;       ///< in random poses, each on its own: one repeat is their mean
};

/// Grains bonded side by side, on a plate that tilts until they slide.
///
/// The grains touch, long axes parallel and level, shortest axes upright. The plate turns about
/// the direction of the long axes: down the slope lies the line from grain to grain, the one way in
/// which they can neither roll nor rock. A single grain rolls.
///
/// Value: the plate's angle at the onset of sliding, degrees. Slip grows as the cube of the time
/// since the onset; the line through its cube root is followed back to no slip. Readings:
/// "half_mm_slip_deg" (the plate's angle once the body has slipped half a millimetre; what others
/// report) and "begin_deg" (where the turning began). Throws NoReading for a body that tips or
/// rolls, or holds up to 89 degrees. There is no chance in it: the seed changes nothing.
/// Nor would chance be of use: as long as the body slides, its angle is that of friction whatever
/// its pose, and with the row across the slope ellipsoids roll over their ends once
/// tan(angle) = (a^2 - b^2) / 2ab (half-axes a > b: 14 degrees for a hazelnut), before they slide.
/// The scatter of a bench is that of its surfaces.
struct TiltProtocol {
  int bonded = 2;
  double rate_deg_s = 2;
  /// At least. The plate begins later, just short of where the body slides or tips, since a body
  /// that does not move has no history: Tilt.DoesNotDependOnWhereItBegins.
  double start_deg = 0;
};

/// One grain let go on an incline that ends on a flat plate.
///
/// It lies on the incline, its long axis across the slope but for a turn, and otherwise at random.
/// Value: how far along the flat its centroid lies from the foot once it is at rest, mm. A grain
/// that stays on the incline is released again, up to ten times, as at a bench; then it has a value
/// below 0: less its distance up the incline. Readings: "lateral_mm" (aside), "stopped_on_incline"
/// (0 or 1), "releases", "time_s". Throws NoReading for a grain that does not stop.
struct RollProtocol {
  double incline_deg = 20;
  double release_m = .15;        ///< from the foot of the incline, along it
  double release_turn_deg = 10;  ///< of the long axis from lying across the slope, at most
};

/// A tube filled with grains and lifted off a plate.
///
/// The result is `Repeat::envelopes`, the heap's outline from all around: a line through them gives
/// its angle, and there is no value yet. Readings: "grains" (when the lift began),
/// "grains_on_plate", "grains_off_plate", "height_mm", "no_heap" (1: the grains spread in a layer
/// too low to be a heap, below 2.5 grain diameters), "at_rest" (0: still creeping 5 s after the
/// tube was away, as constant torques let heaps do), "time_s" (of lift and settling). Throws
/// NoReading when the grains stay in the tube or leave the plate.
struct HeapProtocol {
  double tube_diameter_m = .1;  ///< inner
  double tube_height_m = .4;
  double tube_thickness_m = .002;
  double lift_speed_m_s = .03;
  double plate_m = .4;  ///< side of the square plate
  double plate_thickness_m = .002;
  std::optional<int> grains;  ///< or as many as fill the tube, levelled at its rim
  /// How many fit depends on their friction: where `grains` do not, take those that do. Without it
  /// they are refused.
  bool may_be_fewer = false;
};

/// Grains bonded side by side, as in TiltProtocol, on a plate that is covered with glued grains of
/// the same kind (glued_bed.h): nothing but grains touch.
///
/// They are put down at random places of a random bed, fall into its hollows, and the plate turns
/// from level. Value: the plate's angle when they last stood still before they slid by a grain's
/// diameter, degrees, mean of the places: shifts within a hollow do not count. It has interlocking
/// in it, and is above the angle of friction. Readings: "first_shift_deg" (the angle at a shift of
/// a tenth of a diameter, their mean) and "sd_deg" (scatter of the value between places). Throws
/// NoReading for grains that hold on up to 89 degrees.
struct GrainTiltProtocol {
  int bonded = 3;
  double rate_deg_s = 5;
  int places = 10;        ///< each with grains of its own: one repeat is their mean
  double coverage = .75;  ///< part of the plate that the glued grains hide
};

/// The same with single grains, which roll out of their hollows.
struct GrainRollProtocol {
  double rate_deg_s = 5;
  int places = 10;
  double coverage = .75;
};

/// Single grains dropped on such a plate, else as in DropProtocol: same value, same readings.
struct GrainDropProtocol {
  double height_m = .2;  ///< of the lowest point above the highest glued grain
  int grains = 20;       ///< in random poses over random places, each on its own
  double coverage = .75;
};

/// A tube filled by pouring and struck level at its rim.
///
/// The grains fall from a spout at `pour_m` above the rim, at random places over the tube and in
/// random poses, until they heap over the rim and rest. Those whose centres of mass lie above the
/// rim are struck off; all others stay whole. Value: bulk density, kg/m^3: the mass of those that
/// stay by the tube's volume. Readings: "grains", "mass_g", "solid_fraction".
struct FillProtocol {
  double tube_diameter_m = .1;  ///< inner
  double tube_height_m = .1;
  double pour_m = .05;  ///< from the spout to the rim
};

/// Two equal grains on strings, side by side: one is drawn aside, let go, and strikes the other.
///
/// The strings are as long as from the hinge to the grain's middle. Value: the angle to which the
/// struck grain swings, degrees, mean of the pairs, all of them grains in random poses that meet
/// with their middles at the same height. Between equal balls of restitution e its height is
/// ((1 + e) / 2)^2 of the other's. Readings: "rise_mm" (that height), "height_ratio" and "sd_deg"
/// (scatter of the value between pairs).
struct PendulumProtocol {
  double string_m = .3;
  double release_deg = 30;
  int pairs = 10;
};

/// Every experiment there is, in the order in which they are listed.
enum class Experiment {
  drop,
  tilt,
  roll,
  heap,
  drop_on_grains,
  tilt_on_grains,
  roll_on_grains,
  fill,
  pendulum
};

/// How an experiment is done; its alternatives are in the order of Experiment.
using Protocol =
    std::variant<DropProtocol, TiltProtocol, RollProtocol, HeapProtocol, GrainDropProtocol,
                 GrainTiltProtocol, GrainRollProtocol, FillProtocol, PendulumProtocol>;

/// One repeat of an experiment.
struct Repeat {
  double value = 0;  ///< in the unit of the experiment; NaN for a heap
  std::uint64_t seed = 0;
  std::int64_t steps = 0;
  double timestep_s = 0;
  double clump_steps = 0;  ///< grains times steps, summed
  /// Other readings, named with their unit: "lowest_point_rise_mm", "grains_off_plate".
  std::map<std::string, double> readings;
  std::vector<HeapEnvelope> envelopes = {};  ///< of a heap, from 18 sides; else empty
  /// The end of the run, to look at; shared because a simulation cannot be copied.
  std::shared_ptr<const Simulation> state;
};

/// Called periodically with the completed fraction (0 ... 1); returns false to cancel the run.
using ProgressReport = std::function<bool(double fraction, const Simulation&)>;

/// What a run hands out on its way, beside its reports; each may be left out.
struct RunRecord {
  /// Is shown each simulation of the run at its beginning, and then at the steps nearest to the
  /// multiples of `frame_interval_s` (above 0) of its time.
  std::function<void(const Simulation&)> frame;
  double frame_interval_s = 0;
  /// Heaps only, the others take seconds: is handed what resume_heap() needs, whenever
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
class NoReading : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Each runs one repeat. The same seed gives the same bytes at any number of threads. They throw
// std::invalid_argument for a protocol that cannot be run (every error at once), UnstableRun for a
// run that went wrong, NoReading and Interrupted as said there.
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

/// Goes on with a heap that was interrupted, to the same bytes as one that was not. `from` must be
/// of the same bench, protocol and seed, which is not checked.
Repeat resume_heap(const Model& model, const HeapProtocol& protocol, std::uint64_t seed,
                   const HeapRestart& from, const ProgressReport& report = {},
                   const RunRecord& record = {});

}  // namespace repose::dem
