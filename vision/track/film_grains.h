#pragma once

#include <filesystem>
#include <vector>

#include "vision/film/film_file.h"
#include "vision/film/film_survey.h"
#include "vision/film/repeat_finder.h"
#include "vision/track/grain_path.h"

namespace repose::vision {

/// All that moved in a film.
struct FilmGrains {
  FilmSurvey survey;
  cv::Mat scene = {};
  std::vector<GrainPath> paths = {};     ///< the longest way first, less the scene's shifts
  std::vector<cv::Point2d> shifts = {};  ///< of the scene in each frame [px]
  RepeatedFrames repeated = {};          ///< these are in no path
  /// When frames may have been taken if not at their time stamps, a list of all frames each: in a
  /// pattern of repeats, or evenly where the stamps are not.
  std::vector<std::vector<double>> other_times_s = {};
};

/// The same film with each frame taken at another time.
FilmGrains retimed(const FilmGrains& film, const std::vector<double>& times_s);

double farthest_shift_px(const FilmGrains& film);

/// Looks through the film twice: for the scene, and for what moves before it. Scenes that change as
/// a whole, and films of a few frames, are looked through once: they have no paths.
/// @throws base::InputError  see FilmReader.
FilmGrains grains_in_film(const FilmFile& file, const FilmProgress& progress);

}  // namespace repose::vision
