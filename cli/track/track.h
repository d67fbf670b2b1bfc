#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/measured/tracked_film.h"
#include "cli/common/command.h"
#include "cli/common/output.h"
#include "cli/common/picture_options.h"

namespace repose::cli {

/// The arguments of `repose track`, as typed.
struct TrackArguments {
  std::string experiment;
  std::vector<std::string> videos;
  ScaleArguments scale;
  std::string released;
  std::string fps;
  std::string bounces;
  std::string overlay;
  std::string json_file;
  std::string csv_file;
  std::string threads;
};

/// Runs `repose track`.
ExitCode run_track(const TrackArguments& arguments);

/// A `repose track` that can be carried out.
struct TrackPlan {
  vision::Filmed filmed = vision::Filmed::drop;
  std::vector<std::filesystem::path> videos;
  std::vector<std::filesystem::path> overlays;  ///< one per film, or empty
  vision::ScaleOptions scale;
  std::optional<double> released_mm;   ///< for rolls; instead of a scale
  std::optional<double> frames_per_s;  ///< of films that are folders of frames
  bool tells_all_bounces = false;
  int threads = 1;

  std::vector<std::string> errors;  ///< empty: it can be carried out
  std::vector<std::string> notes;   ///< for the user
};

/// Reads and checks all arguments, and whether the output can be written. Reports all errors at
/// once.
TrackPlan plan_track(const TrackArguments& arguments);

using calibrate::TrackedFilm;

/// Tracks the plan's films, several at a time; results are in the plan's order and do not depend on
/// the number of threads. Stops in the middle of a film when `is_interrupted`; the result is then
/// unusable.
std::vector<TrackedFilm> track_batch(const TrackPlan& plan,
                                     const std::atomic<bool>& is_interrupted);

Command track_command();

}  // namespace repose::cli
