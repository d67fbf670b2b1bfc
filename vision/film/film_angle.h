#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "vision/camera/sized_heap.h"
#include "vision/film/film_file.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

/// The angle of repose of a heap that was filmed while it came to rest.

namespace repose::vision {

/// File name endings of films, in lower case.
inline constexpr std::array<std::string_view, 7> kFilmEndings{".mp4", ".m4v",  ".mov", ".avi",
                                                              ".mkv", ".webm", ".gif"};

/// Whether a file's name has the ending of a film.
bool has_film_ending(const std::filesystem::path& file);

/// The part of a film from which one picture was made.
struct FilmStretch {
  double from_s = 0;  ///< by the film's own time stamps, from its first frame
  double to_s = 0;
  int frames = 0;  ///< averaged in the picture
};

struct FilmAngle {
  SizedHeap heap;   ///< of the picture, or why there is none; with warnings about the film
  Picture picture;  ///< the heap at rest; a late frame if nothing comes to rest
  std::optional<FilmStretch> stretch = {};  ///< whose mean the picture is; std::nullopt: no rest
  FilmFacts film = {};
  std::vector<double> times_s = {};  ///< of each frame
};

/// Finds the last second in which nothing moves, and measures the mean of its frames like any other
/// picture, with a lens, a scale or a board. Changes due to sensors, lamps and codecs do not count
/// as movement, nor do small things that change throughout the film above or below the scene (a
/// timer), nor anything in the options' excluded boxes or outside their box around the heap. A hand
/// that enters from the left, the right or below afterwards does no harm; a heap that continues to
/// grow then is refused.
///
/// Decodes the film three times and stores few frames: memory does not grow with its length.
/// @param progress  called with the completed fraction, from 0 to 1; may throw to cancel
/// @throws base::InputError  "FILE: what. Fix: ...": it is not a readable film; or as
///   measure_sized_heap().
FilmAngle measure_film(const FilmFile& file, const MeasureOptions& options = {},
                       const ScaleOptions& scale = {},
                       const std::function<void(double)>& progress = {});

/// A frame of a film.
struct TimedPicture {
  double time_s = 0;
  Picture picture;
};

/// A film's frames nearest to 0, one step, two steps ... up to the last frame; each once, in order.
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

  /// Times of the frames that next() returns.
  const std::vector<double>& times_s() const { return taken_s_; }
  /// std::nullopt at the end.
  std::optional<TimedPicture> next();

 private:
  class Decoder;

  std::unique_ptr<Decoder> decoder_;
  std::vector<std::size_t> taken_;  ///< frame numbers
  std::vector<double> taken_s_;     ///< their times
  std::size_t done_ = 0;            ///< how many of those were returned
};

}  // namespace repose::vision
