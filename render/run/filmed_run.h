#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "vision/picture/picture.h"

/// A run as a film camera sees it: so many frames a second, each exposed for a time.

namespace repose::render {

/// What was between two states of a run.
///
/// Grains go along the cubic that has their places and velocities in both (Hermite; Bartels, Beatty
/// & Barsky 1987, An introduction to splines, ch. 3), which a free flight follows exactly, and turn
/// evenly from one pose to the other; walls do both evenly. Proved by Between.* in
/// tests/render/filmed_run_test.cpp.
/// @param part  of the time from `a` to `b`, 0 to 1
/// @param interval_s  that time
/// @returns `a` where grains or walls are there that are not in the other
Scene between(const Scene& a, const Scene& b, double part, double interval_s);

/// The states of a run, wherever they are kept.
struct RunStates {
  std::vector<double> times_s;              ///< of each, rising
  std::function<Scene(std::size_t)> scene;  ///< of the state of this number
};

struct Shutter {
  double frames_per_s = 60;
  double exposure_s = 0;  ///< of each frame, at most the time between two
  double hold_s = 0;      ///< the first and the last state are seen this much longer
};

class FilmedRun {
 public:
  /// @throws base::InputError  no states, or a shutter that cannot be.
  FilmedRun(RunStates states, const Shutter& shutter);

  int frames() const { return frames_; }
  const Shutter& shutter() const { return shutter_; }
  /// When a frame is half exposed, by the run's clock.
  double time_s(int frame) const;
  /// What is seen then.
  Scene scene_at(double time_s);
  /// While a frame is exposed, evenly spread.
  std::vector<Scene> moments(int frame, int count);
  /// All moments have the setting of this one, which is the first: cameras are put up before it.
  const Scene& first() const { return first_; }

 private:
  /// @param kept  the number of one that is still in use
  const Scene& state(std::size_t number, std::size_t kept);

  /// A state that was read.
  struct Read {
    std::size_t number = 0;
    Scene scene;
  };

  RunStates states_;
  Shutter shutter_;
  int frames_ = 0;
  std::function<Scene(Scene)> on_bench_;
  Scene first_;
  std::optional<Read> one_, other_;  ///< those read last
};

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
  std::vector<Frame> frames;  ///< none where there are more than kMaxPlaced grains
};

inline constexpr std::size_t kMaxPlaced = 100;

/// @throws base::InputError  as FilmedRun and view_of().
FilmTruth film_truth_of(FilmedRun& run, const Camera& camera, const PictureSize& size);

}  // namespace repose::render
