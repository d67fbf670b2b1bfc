#pragma once

#include <string>
#include <vector>

#include "vision/track/film_grains.h"
#include "vision/track/track.h"

/// What is wrong with a film, whatever it shows.
namespace repose::vision {

FilmFacts facts_of(const FilmSurvey& survey);

/// Why nothing can be read off it; empty: something may.
std::string fault_of(const FilmGrains& film);

/// Adds what is to be known of it.
/// @returns whether a person must look at something first
bool warn_of_film(const FilmGrains& film, std::vector<Warning>& warnings);

}  // namespace repose::vision
