#pragma once

#include <string>
#include <vector>

#include "cli/common/exit_code.h"
#include "cli/common/scale_option.h"

namespace repose::cli {

/// What `repose track` is asked to do, as typed.
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

/// Carries out `repose track`.
ExitCode run_track(const TrackArguments& arguments);

}  // namespace repose::cli
