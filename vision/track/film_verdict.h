#pragma once

#include <string>
#include <vector>

#include "vision/track/film_grains.h"
#include "vision/track/track.h"

/// What is wrong with a film, whatever it shows.
namespace repose::vision {

FilmFacts facts_of(const FilmSurvey& survey);

/// Why nothing can be read off it, whatever moves in it; empty: something may.
/// @param moved_px  how far the camera moves
std::string fault_of_shot(const FilmSurvey& survey, double moved_px);
/// The same, and whether anything moves.
std::string fault_of(const FilmGrains& film);

/// Adds what is to be known of it.
/// @returns whether a person must look at something first
bool warn_of_film(const FilmSurvey& survey, double moved_px, std::vector<Warning>& warnings);
bool warn_of_film(const FilmGrains& film, std::vector<Warning>& warnings);

}  // namespace repose::vision
