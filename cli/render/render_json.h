#pragma once

#include <string>

#include "render/run/film_truth.h"
#include "render/truth.h"

namespace repose::cli {

/// What is known exactly about a picture, for programs.
std::string truth_json(const render::Truth& truth);
/// The same about a film.
std::string film_truth_json(const render::FilmTruth& truth);

}  // namespace repose::cli
