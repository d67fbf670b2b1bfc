#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/track/track.h"
#include "vision/track/track.h"

namespace repose::cli {

/// The experiments that films are read of.
enum class Filmed { drop, roll, tilt };

/// A `repose track` that can be carried out.
struct TrackPlan {
  Filmed filmed = Filmed::drop;
  std::vector<std::filesystem::path> videos;
  std::vector<std::filesystem::path> overlays;  ///< one a film, or none
  vision::ScaleOptions scale;
  std::optional<double> released_mm;   ///< of rolls; in place of a scale
  std::optional<double> frames_per_s;  ///< of films that are folders of frames
  bool tells_all_bounces = false;
  int threads = 1;

  std::vector<std::string> errors;  ///< empty: it can be carried out
  std::vector<std::string> notes;   ///< for the user to know
};

/// Reads and checks all that was typed, also whether the output can be written. All errors at once.
TrackPlan plan_track(const TrackArguments& arguments);

}  // namespace repose::cli
