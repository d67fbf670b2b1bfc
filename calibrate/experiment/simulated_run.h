#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/experiment/heap_views.h"
#include "dem/experiment/experiment.h"

namespace repose::calibrate {

/// What a run gave.
struct SimulatedRun {
  std::uint64_t seed = 0;
  /// As the engine gives it: of a heap, its angle from where the grains lie.
  std::optional<double> value;
  std::map<std::string, double> readings;  ///< as dem::Repeat::readings; NaN: there is none
  std::int64_t steps = 0;
  double timestep_s = 0;
  double clump_steps = 0;
  std::vector<HeapView>
      views;  ///< pictures of a heap; empty: none were asked for, or could be drawn
  std::optional<HeapCamera> camera;  ///< that took them; none: from far away
  /// Of a heap, as `value` but by the other definitions of base/angle_definition.h, by name.
  std::map<std::string, double> other_deg;
  /// The definition by which its angle is asked for; empty: the usual one. All are kept: it is read
  /// anew by another without being simulated again.
  std::string definition;
  /// Why there is nothing to read ("the grains stay in the tube"). What else is known of the run,
  /// such as the height of a layer, stays in `readings`.
  std::string failure;
  std::string picture_error;           ///< why this machine could not draw
  double wall_s = 0;                   ///< of the simulation, in all calls that worked on it
  std::optional<double> trajectory_s;  ///< between the frames of its film; none: there is no film
};

/// Why the grains of a heap experiment make none: they spread to a layer ("no_heap" among the
/// readings), or stand so that less than half of their sides slope (no value). Empty: they do, or
/// the run is of another experiment.
std::string no_heap_reason(const SimulatedRun& run);

/// It was measured by the definition. Runs without views or a value lack nothing.
bool has_definition(const SimulatedRun& run, const std::string& definition);

/// Its pictures are those that are asked for.
bool is_pictured_as(const SimulatedRun& run, const HeapViewing& asked);

/// A heap's value is its angle in pictures where at least half of the views could be measured: it
/// is what a photograph of the bench is compared with. Else, and of all other experiments, it is
/// what the engine gives.
///
/// Each run decides for itself. A rule over all repeats, that one bad heap turns the others to
/// positions too, would make a run's value depend on which others were asked for with it: the same
/// run would count with one number in a mean of five, with another in a mean of ten, and with a
/// third in a fit. The price is that a mean may be of both kinds, which differ by a degree or so:
/// each run says which it is ("from_pictures"), and a mean of both is warned of.
bool is_from_pictures(const SimulatedRun& run);
/// Its angle by its definition in all views, and from where the grains lie.
PictureMean picture_mean(const SimulatedRun& run);
std::optional<double> position_value(const SimulatedRun& run);
/// None of a run with a failure.
std::optional<double> value_of(const SimulatedRun& run);
/// Of a heap, its value by each definition that it allows, in the order of
/// base/angle_definition.h; of other experiments none.
std::vector<std::pair<std::string, double>> values_by_definition(const SimulatedRun& run);

/// The standard deviation s sqrt(1 - 1/n) by which the angle in one view scatters within a heap
/// more than the mean of n views that scatter by s.
inline constexpr const char* kOneViewScatter = "sd_of_one_view_deg";

/// All readings as a fit or a table has them, those that do not exist left out: the engine's,
/// "value", "timestep_s", and of a pictured run "angle_from_positions_deg", "views_measured",
/// "views_flagged", "from_pictures" (0 or 1), "angle_from_pictures_deg" and
/// "sd_between_views_deg", and kOneViewScatter.
std::map<std::string, double> readings_of(const SimulatedRun& run);

/// What must be known of rolls with elastic-plastic rolling friction whose grain hopped, at the
/// highest by `hop_mm`: each landing takes speed, the more of them the higher the restitution
/// (dem/THEORY.md, Rolling resistance). Empty where it hardly hopped, and for other laws.
std::string warning_of_hops(dem::RollingModel rolling, const dem::ClumpShape& grain, double hop_mm);

/// As JSON, to be stored or sent to another process: every number comes back to the last bit.
std::string run_text(const SimulatedRun& run);
/// None for a text that is not one of run_text, or has numbers that no run gives. Versions up to 8
/// of the simulator wrote 0 for each angle that a heap does not have, and gave layers theirs: such
/// runs come back with a failure.
std::optional<SimulatedRun> run_in(const std::string& text);

}  // namespace repose::calibrate
