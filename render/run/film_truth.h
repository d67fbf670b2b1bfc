#pragma once

#include <array>
#include <vector>

#include "render/run/filmed_run.h"
#include "render/scene/camera.h"
#include "vision/picture/picture.h"

namespace repose::render {

/// Where a grain's centre of mass is.
struct GrainPlace {
  dem::Vector position_m = dem::Vector::Zero();
  vision::Point picture;  ///< [px]
};

/// What is known exactly about the film of a run. Lengths in pixels as in vision/picture/picture.h.
struct FilmTruth {
  Camera camera;
  PictureSize size;
  double frames_per_s = 0;
  double exposure_s = 0;
  double mm_per_px = 0;  ///< in the upright plane through the middle of the grains' way
  /// Two points of that plane on a level, and how far apart they are: a ruler in the picture.
  vision::Segment scale;
  double scale_mm = 0;
  struct Frame {
    double run_s = 0;  ///< by the run's clock, when the frame is half exposed
    std::vector<GrainPlace> grains;
  };
  std::vector<Frame> frames;  ///< none where there are more than kMostPlaced grains
};

inline constexpr std::size_t kMostPlaced = 100;

/// @throws base::InputError  as FilmedRun and view_of().
FilmTruth film_truth_of(FilmedRun& run, const Camera& camera, const PictureSize& size);

}  // namespace repose::render
