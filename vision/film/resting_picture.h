#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vision/film/film_angle.h"
#include "vision/film/film_file.h"
#include "vision/film/film_survey.h"
#include "vision/measure/repose_angle.h"

/// Errors and warnings of films, and the picture of a heap at rest.

namespace repose::vision {

FilmFacts facts_of(const FilmSurvey& survey);

/// Why nothing can be measured in it, whatever moves; empty if it can.
/// @param moved_px  the camera's movement
std::string fault_of_shot(const FilmSurvey& survey, double moved_px);

/// Why movement cannot be tracked in an interlaced film, whose frames consist of two fields; empty
/// if it is not interlaced. Still scenes are the same in both fields.
std::string fault_of_fields(const FilmSurvey& survey);

/// Adds warnings about the film.
/// @returns whether the user must check something first
bool warn_of_film(const FilmSurvey& survey, double moved_px, std::vector<Warning>& warnings);

/// A heap at rest, taken from its film.
struct RestingPicture {
  std::string reason;  ///< why there is none; empty if there is one
  Picture picture;     ///< if there is none, a late frame of the film
  std::optional<FilmStretch> stretch;
  FilmFacts film;
  std::vector<double> times_s;  ///< of each frame
  std::vector<Warning> warnings;
  bool is_doubtful = false;  ///< the user must check a warning first
};

/// See measure_film().
RestingPicture resting_picture(const FilmFile& file, const MeasureOptions& options,
                               const FilmProgress& progress);

}  // namespace repose::vision
