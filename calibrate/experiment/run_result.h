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

/// One run of one experiment: what was simulated, the engine's results, and the measurements of its
/// pictures. Used by stores, the fit, tables and reports.
struct RunResult : dem::Repeat {
  std::string simulated = "null";  ///< what was simulated, as description_of()
  /// Pictures of a heap; empty: none were requested, or none could be drawn.
  std::vector<HeapView> views;
  std::optional<dem::LevelCamera> camera;  ///< that took them; std::nullopt: from far away
  /// For heaps: like `value`, but by the other definitions of base/angle_definition.h, keyed by
  /// name.
  std::map<std::string, double> other_deg;
  /// The requested definition of its angle; empty: the default. All are saved, so it can be read by
  /// another one without simulating again.
  std::string definition;
  /// Why there is no reading ("the grains stay in the tube"). Other results, such as the height of
  /// a layer, remain in `readings`.
  std::string failure;
  std::string picture_error;           ///< why this machine could not draw
  double wall_s = 0;                   ///< of the simulation, over all calls that worked on it
  std::optional<double> trajectory_s;  ///< between the frames of its film; std::nullopt: no film
};

/// Measures a heap from run_heap() or resume_heap(): adds the angle of its envelopes in degrees as
/// its value, also by the other definitions, and the readings "base_radius_mm", "between_views_deg"
/// (scatter between directions), "angle_xz_deg" (seen along y) and "inner_window_deg" (as the
/// value, but fitted from 30 to 70 % of the height instead of 20 to 80: low heaps are concave at
/// the foot, so their angle depends on the window). A layer ("no_heap" 1) has none of these
/// numbers.
void add_position_angle(RunResult& heap);

/// Why the grains of a heap experiment do not form a heap: they spread to a layer ("no_heap" among
/// the readings), or fewer than half of their flanks slope (no value). Empty: they do, or it is
/// another experiment.
std::string no_heap_reason(const RunResult& run);

/// Whether it was measured by the definition; also true for runs without views or a value.
bool has_definition(const RunResult& run, const std::string& definition);

/// Whether its pictures are as requested.
bool is_pictured_as(const RunResult& run, const HeapViewing& asked);

/// A heap's value is its angle in pictures if at least half of the views could be measured:
/// photographs of the bench are compared with it. Otherwise, and for all other experiments, it is
/// the engine's value.
///
/// This is decided for each run separately. If one bad heap switched all repeats to positions, a
/// run's value would depend on the other runs requested with it: the same run would have one value
/// in a mean of five, another in a mean of ten, and a third in a fit. The price is that a mean may
/// mix both kinds, which differ by a degree or so: each run records its kind ("from_pictures"), and
/// a mixed mean gives a warning.
bool is_from_pictures(const RunResult& run);
/// Its angle by its definition: over all views, and from the positions of its grains.
PictureMean picture_mean(const RunResult& run);
std::optional<double> position_value(const RunResult& run);
/// std::nullopt for a run with a failure.
std::optional<double> value_of(const RunResult& run);
/// For a heap, its value by each definition that it allows, in the order of
/// base/angle_definition.h; empty for other experiments.
std::vector<std::pair<std::string, double>> values_by_definition(const RunResult& run);
/// Means of these over runs, by the definitions that all runs allow.
std::vector<std::pair<std::string, double>> means_by_definition(const std::vector<RunResult>& runs);

/// The additional scatter within a heap, as standard deviation s sqrt(1 - 1/n), of the angle in one
/// view compared with the mean of n views whose standard deviation is s.
inline constexpr const char* kOneViewScatter = "sd_of_one_view_deg";

/// All readings for fits and tables, without missing ones: the engine's, "value", "timestep_s", and
/// for a pictured run "angle_from_positions_deg", "views_measured", "views_flagged",
/// "from_pictures" (0 or 1), "angle_from_pictures_deg" and "sd_between_views_deg", and
/// kOneViewScatter.
std::map<std::string, double> readings_of(const RunResult& run);

/// A warning for rolls with elastic-plastic rolling friction whose grain hopped, by at most
/// `hop_mm`: each landing costs speed, and higher restitution means more landings (dem/THEORY.md,
/// Rolling resistance). Empty if it hardly hopped, and for other laws.
std::string warning_of_hops(dem::RollingModel rolling, const dem::ClumpShape& grain, double hop_mm);

/// As JSON with a fingerprint, to be stored or sent to another process: every number is restored to
/// the last bit, and the same run gives the same bytes. The definition is not saved: the reader
/// chooses it.
std::string text_of(const RunResult& run);

/// Simulator versions up to 8 wrote 0 for missing angles of a heap, and gave layers an angle: such
/// runs are returned with a failure.
/// @throws base::InputError  the text was changed, or has numbers that no run gives; the message
///   says what is wrong.
RunResult run_in(const std::string& text);

}  // namespace repose::calibrate
