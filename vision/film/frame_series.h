#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "vision/film/film_file.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// A frame of a film.
struct TimedPicture {
  double time_s = 0;
  Picture picture;
};

/// Of a film the frames nearest to 0, a step, two steps ... up to its last frame; each once, in
/// order.
class FrameSeries {
 public:
  /// @param times_s  of each frame, see FilmAngle
  /// @throws base::InputError  as measure_film().
  FrameSeries(const FilmFile& file, const std::vector<double>& times_s, double step_s);
  ~FrameSeries();
  FrameSeries(const FrameSeries&) = delete;
  FrameSeries& operator=(const FrameSeries&) = delete;
  FrameSeries(FrameSeries&&) = delete;
  FrameSeries& operator=(FrameSeries&&) = delete;

  /// Of the frames that next() gives.
  const std::vector<double>& times_s() const { return taken_s_; }
  /// None at the end.
  std::optional<TimedPicture> next();

 private:
  class Decoder;

  std::unique_ptr<Decoder> decoder_;
  std::vector<std::size_t> taken_;  ///< which frames
  std::vector<double> taken_s_;     ///< their times
  std::size_t done_ = 0;            ///< of those taken
};

}  // namespace repose::vision
