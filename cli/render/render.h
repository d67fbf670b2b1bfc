#pragma once

#include <string>

#include "cli/common/output.h"
#include "cli/common/position_options.h"

namespace repose::cli {

/// The arguments of `repose render`, as typed.
struct RenderArguments {
  std::string state;  ///< .vtp, or .pvd for a film; or a particle file
  PositionArguments positions;
  std::string view;   ///< xz or an azimuth in degrees
  std::string style;  ///< silhouette|photo
  std::string size;   ///< W,H in pixels
  std::string mm_per_px;
  std::string camera;  ///< KEY=VALUE,...
  std::string show;    ///< mesh|spheres|both
  std::string seed;
  std::string passes;
  std::string study;
  std::string turntable;  ///< frames
  std::string fps;        ///< of a trajectory's film
  std::string exposure_ms;
  std::string hold_s;
  std::string noise;
  std::string mask_file;
  std::string truth_file;
  std::string out_file;
};

/// Runs `repose render`.
ExitCode run_render(const RenderArguments& arguments);

}  // namespace repose::cli
