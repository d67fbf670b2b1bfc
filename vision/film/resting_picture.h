#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vision/film/film_angle.h"
#include "vision/film/film_file.h"
#include "vision/film/film_survey.h"

namespace repose::vision {

/// A heap at rest, out of its film.
struct RestingPicture {
  std::string reason;  ///< why there is none; empty: there is
  Picture picture;     ///< without one, a late frame of the film
  std::optional<FilmStretch> stretch;
  FilmFacts film;
  std::vector<double> times_s;  ///< of each frame
  std::vector<Warning> warnings;
  bool is_doubtful = false;  ///< a person must look at a warning first
};

/// See measure_film().
RestingPicture resting_picture(const FilmFile& file, const MeasureOptions& options,
                               const FilmProgress& progress);

}  // namespace repose::vision
