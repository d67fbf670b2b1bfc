#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/film/film_angle.h"
#include "vision/film/film_survey.h"
#include "vision/film/rest_finder.h"

/// What is wrong with a film of a heap that is to come to rest.
namespace repose::vision {

/// Of few frames a second no rest can be seen.
std::string fault_of_rate(const FilmSurvey& survey);

/// Why nothing at rest can be taken out of the film; empty: it can.
std::string fault_of_rest(const RestFinder& finder, const FilmSurvey& survey);

/// Adds what is to be known of the film and of the stretch that was taken.
/// @param writing  see writing_in()
/// @returns whether a person must look at something first
bool warn_of_rest(const FilmSurvey& survey, const FilmStretch& stretch, const cv::Mat& writing,
                  std::vector<Warning>& warnings);

}  // namespace repose::vision
