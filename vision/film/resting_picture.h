#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vision/film/film_angle.h"
#include "vision/film/film_file.h"
#include "vision/film/film_survey.h"
#include "vision/measure/repose_angle.h"

/// What is wrong with a film, whatever it shows.

namespace repose::vision {

FilmFacts facts_of(const FilmSurvey& survey);

/// Why nothing can be read off it, whatever moves in it; empty: something may.
/// @param moved_px  how far the camera moves
std::string fault_of_shot(const FilmSurvey& survey, double moved_px);

/// Why nothing that moves can be followed in it, where frames are made of two fields; empty: they
/// are whole. What lies still is the same in both.
std::string fault_of_fields(const FilmSurvey& survey);

/// Adds what is to be known of it.
/// @returns whether a person must look at something first
bool warn_of_film(const FilmSurvey& survey, double moved_px, std::vector<Warning>& warnings);

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
