#pragma once

#include <string>
#include <vector>

#include "vision/film/shot_verdict.h"
#include "vision/track/film_grains.h"

/// What is wrong with a film of grains.
namespace repose::vision {

/// What is wrong with the shot, or that nothing moves in it.
std::string fault_of(const FilmGrains& film);

/// Adds what is to be known of it.
/// @returns whether a person must look at something first
bool warn_of_film(const FilmGrains& film, std::vector<Warning>& warnings);

}  // namespace repose::vision
