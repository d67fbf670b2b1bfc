#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/film/film_file.h"

namespace repose::vision {

/// Called with the completed fraction, from 0 to 1.
using FilmProgress = std::function<void(double)>;

/// Fewer frames cannot show movement.
inline constexpr int kFewestFrames = 8;

/// The result of one pass through a film.
struct FilmSurvey {
  cv::Size size;
  std::vector<double> times_s;  ///< of each frame
  double interval_s = 0;        ///< median between frames
  int claimed_frames = 0;
  int dropped_frames = 0;          ///< that would fit into the gaps between time stamps
  bool has_variable_rate = false;  ///< frames are unevenly spaced, apart from gaps
  std::optional<int> cut;          ///< the first frame of another scene
  bool is_interlaced = false;
  std::vector<cv::Mat> samples;  ///< spread evenly over the film; few, whatever its length
};

/// @throws base::InputError  see FilmReader.
FilmSurvey survey_film(const FilmFile& file, const FilmProgress& progress);

}  // namespace repose::vision
