#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/experiment/heap_angle.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"

namespace repose::calibrate {

/// One run of one experiment: what was simulated, what the engine gave, and what its pictures
/// showed. Stores, the fit, tables and reports all take it from here.
struct RunResult : dem::Repeat {
  std::string simulated = "null";  ///< what it is a run of, as description_of()
  /// Pictures of a heap; empty: none were asked for, or could be drawn.
  std::vector<HeapView> views;
  std::optional<dem::LevelCamera> camera;  ///< that took them; none: from far away
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

/// Measures a heap as run_heap() or resume_heap() gives it: takes its envelopes, and adds their
/// angle in degrees as its value, by the other definitions too, and the readings "base_radius_mm",
/// "between_views_deg" (scatter between directions), "angle_xz_deg" (seen along y) and
/// "inner_window_deg" (as the value, but fitted from 30 to 70 % of the height instead of 20 to 80:
/// low heaps are hollow at the foot, and the stretch moves their angle). A layer ("no_heap" 1) has
/// none of these numbers.
void add_position_angle(RunResult& heap);

/// Why the grains of a heap experiment make none: they spread to a layer ("no_heap" among the
/// readings), or stand so that less than half of their sides slope (no value). Empty: they do, or
/// the run is of another experiment.
std::string no_heap_reason(const RunResult& run);

/// It was measured by the definition. Runs without views or a value lack nothing.
bool has_definition(const RunResult& run, const std::string& definition);

/// Its pictures are those that are asked for.
bool is_pictured_as(const RunResult& run, const HeapViewing& asked);

/// A heap's value is its angle in pictures where at least half of the views could be measured: it
/// is what a photograph of the bench is compared with. Else, and of all other experiments, it is
/// what the engine gives.
///
/// Each run decides for itself. A rule over all repeats, that one bad heap turns the others to
/// positions too, would make a run's value depend on which others were asked for with it: the same
/// run would count with one number in a mean of five, with another in a mean of ten, and with a
/// third in a fit. The price is that a mean may be of both kinds, which differ by a degree or so:
/// each run says which it is ("from_pictures"), and a mean of both is warned of.
bool is_from_pictures(const RunResult& run);
/// Its angle by its definition in all views, and from where the grains lie.
PictureMean picture_mean(const RunResult& run);
std::optional<double> position_value(const RunResult& run);
/// None of a run with a failure.
std::optional<double> value_of(const RunResult& run);
/// Of a heap, its value by each definition that it allows, in the order of
/// base/angle_definition.h; of other experiments none.
std::vector<std::pair<std::string, double>> values_by_definition(const RunResult& run);
/// Means of that over runs, by the definitions that all of them allow.
std::vector<std::pair<std::string, double>> means_by_definition(const std::vector<RunResult>& runs);

/// The standard deviation s sqrt(1 - 1/n) by which the angle in one view scatters within a heap
/// more than the mean of n views that scatter by s.
inline constexpr const char* kOneViewScatter = "sd_of_one_view_deg";

/// All readings as a fit or a table has them, those that do not exist left out: the engine's,
/// "value", "timestep_s", and of a pictured run "angle_from_positions_deg", "views_measured",
/// "views_flagged", "from_pictures" (0 or 1), "angle_from_pictures_deg" and
/// "sd_between_views_deg", and kOneViewScatter.
std::map<std::string, double> readings_of(const RunResult& run);

/// What must be known of rolls with elastic-plastic rolling friction whose grain hopped, at the
/// highest by `hop_mm`: each landing takes speed, the more of them the higher the restitution
/// (dem/THEORY.md, Rolling resistance). Empty where it hardly hopped, and for other laws.
std::string warning_of_hops(dem::RollingModel rolling, const dem::ClumpShape& grain, double hop_mm);

/// As JSON with a fingerprint, to be stored or sent to another process: every number comes back to
/// the last bit, and the same run gives the same bytes. The definition is the reader's, not kept.
std::string text_of(const RunResult& run);

/// Versions up to 8 of the simulator wrote 0 for each angle that a heap does not have, and gave
/// layers theirs: such runs come back with a failure.
/// @throws base::InputError  the text is not as it was written, or has numbers that no run
/// gives: what is wrong with it.
RunResult run_in(const std::string& text);

}  // namespace repose::calibrate
