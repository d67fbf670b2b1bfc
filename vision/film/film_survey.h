#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/film/film_file.h"

namespace repose::vision {

/// UserHints which fraction of the work is done, from 0 to 1.
using FilmProgress = std::function<void(double)>;

/// Fewer frames show no movement.
inline constexpr int kFewestFrames = 8;

/// What one look through a film tells.
struct FilmSurvey {
  cv::Size size;
  std::vector<double> times_s;  ///< of each frame
  double interval_s = 0;        ///< between frames, in the median
  int claimed_frames = 0;
  int dropped_frames = 0;          ///< that the gaps between time stamps have room for
  bool has_variable_rate = false;  ///< gaps apart, frames do not follow evenly
  std::optional<int> cut;          ///< the first frame of another scene
  bool is_interlaced = false;
  std::vector<cv::Mat> samples;  ///< spread evenly over the film, few whatever its length
};

/// @throws base::InputError  see FilmReader.
FilmSurvey survey_film(const FilmFile& file, const FilmProgress& progress);

}  // namespace repose::vision
