#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "vision/picture/picture.h"

/// A run as a video camera records it: frames at a fixed rate, each with an exposure time.

namespace repose::render {

/// Interpolates between two states of a run.
///
/// Grains follow the cubic with their positions and velocities in both (Hermite; Bartels, Beatty &
/// Barsky 1987, An introduction to splines, ch. 3), exact for free flight, and rotate uniformly
/// from one pose to the other; walls move and rotate uniformly. Proved by Between.* in
/// tests/render/filmed_run_test.cpp.
/// @param part  fraction of the time from `a` to `b`, 0 to 1
/// @param interval_s  that time
/// @returns `a` if the two do not contain the same grains and the same number of walls
Scene between(const Scene& a, const Scene& b, double part, double interval_s);

/// The states of a run, however they are stored.
struct RunStates {
  std::vector<double> times_s;              ///< of each, ascending
  std::function<Scene(std::size_t)> scene;  ///< of the state with this index
};

struct Shutter {
  double frames_per_s = 60;
  double exposure_s = 0;  ///< of each frame, at most the frame interval
  double hold_s = 0;      ///< the first and the last state are shown this much longer
};

class FilmedRun {
 public:
  /// @throws base::InputError  no states, or invalid shutter settings.
  FilmedRun(RunStates states, const Shutter& shutter);

  int frames() const { return frames_; }
  const Shutter& shutter() const { return shutter_; }
  /// Run time at the middle of a frame's exposure.
  double time_s(int frame) const;
  /// The scene at that time.
  Scene scene_at(double time_s);
  /// `count` scenes evenly spread over a frame's exposure.
  std::vector<Scene> moments(int frame, int count);
  /// The first moment, whose setting all others share: cameras are set up for it.
  const Scene& first() const { return first_; }

 private:
  /// @param kept  number of a state that is still in use
  const Scene& state(std::size_t number, std::size_t kept);

  /// A cached state.
  struct Read {
    std::size_t number = 0;
    Scene scene;
  };

  RunStates states_;
  Shutter shutter_;
  int frames_ = 0;
  std::function<Scene(Scene)> on_bench_;
  Scene first_;
  std::optional<Read> one_, other_;  ///< the last two read
};

/// Position of a grain's centre of mass.
struct GrainPlace {
  dem::Vector position_m = dem::Vector::Zero();
  vision::Point picture;  ///< [px]
};

/// Exact ground truth of the film of a run. Lengths in pixels as in vision/picture/picture.h.
struct FilmTruth {
  Camera camera;
  PictureSize size;
  double frames_per_s = 0;
  double exposure_s = 0;
  double mm_per_px = 0;  ///< in the vertical plane through the middle of the grains' paths
  /// Two points of that plane at the same height, and their distance: a ruler in the picture.
  vision::Segment scale;
  double scale_mm = 0;
  struct Frame {
    double run_s = 0;  ///< run time at the middle of the exposure
    std::vector<GrainPlace> grains;
  };
  std::vector<Frame> frames;  ///< empty if there are more than kMaxPlaced grains
};

inline constexpr std::size_t kMaxPlaced = 100;

/// @throws base::InputError  as FilmedRun and view_of().
FilmTruth film_truth_of(FilmedRun& run, const Camera& camera, const PictureSize& size);

}  // namespace repose::render
