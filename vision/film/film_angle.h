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

/// Of names of films, in small letters.
inline constexpr std::array<std::string_view, 7> kFilmEndings{".mp4", ".m4v",  ".mov", ".avi",
                                                              ".mkv", ".webm", ".gif"};

/// Whether a file is taken for a film: by its name.
bool has_film_ending(const std::filesystem::path& file);

/// The part of a film that one picture was made of.
struct FilmStretch {
  double from_s = 0;  ///< by the film's own time stamps, from its first frame on
  double to_s = 0;
  int frames = 0;  ///< in the picture
};

struct FilmAngle {
  SizedHeap heap;   ///< of the picture; or why the film has none, and what is to be known of it
  Picture picture;  ///< the heap at rest; a late frame where nothing in it is
  std::optional<FilmStretch> stretch = {};  ///< what the picture is the mean of; none: no rest
  FilmFacts film = {};
  std::vector<double> times_s = {};  ///< of each frame
};

/// Finds the last second in which nothing moves, and measures the mean of its frames as any other
/// picture, with a lens, a scale or a board. What sensors, lamps and codecs change, and small
/// things that change all through the film above or below the scene (a timer), are no movement; nor
/// is what lies in the options' excluded boxes or outside their box around the heap. A hand that
/// comes in from the left, the right or below afterwards does no harm; a heap that then goes on
/// growing is refused.
///
/// Looks through the film three times, and keeps no frames: memory does not grow with its length.
/// @param progress  told which fraction of the work is done, from 0 to 1; may throw to stop it
/// @throws base::InputError  "FILE: what. Fix: ...": it is no film that can be read; or as
///   measure_sized_heap().
FilmAngle measure_film(const FilmFile& file, const MeasureOptions& options = {},
                       const ScaleOptions& scale = {},
                       const std::function<void(double)>& progress = {});

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
