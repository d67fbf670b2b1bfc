#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "render/scene/scene.h"

/// A run as a film camera sees it: so many frames a second, each exposed for a time.
namespace repose::render {

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

}  // namespace repose::render
