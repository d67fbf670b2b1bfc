#include "vision/track/film_verdict.h"

#include <algorithm>

#include <fmt/format.h>

namespace repose::vision {

std::string fault_of(const FilmGrains& film) {
  std::string fault = fault_of_shot(film.survey, farthest_shift_px(film));
  if (fault.empty()) fault = fault_of_fields(film.survey);
  if (!fault.empty()) return fault;
  if (film.paths.empty()) {
    return "nothing moves before a scene at rest. Fix: film from the side, with a backdrop of "
           "another colour than the grain, and fix exposure and focus.";
  }
  return {};
}

bool warn_of_film(const FilmGrains& film, std::vector<Warning>& warnings) {
  if (film.repeated.count > 0) {
    const auto left_out =
        std::count(film.repeated.is_repeat.begin(), film.repeated.is_repeat.end(), true);
    warnings.push_back(
        {.code = "repeated_frames",
         .message = fmt::format(
             "{} of its frames only repeat the one before them{}: they were "
             "left out",
             left_out, film.repeated.taken_at ? ", in a pattern of another frame rate" : "")});
  }
  return warn_of_film(film.survey, farthest_shift_px(film), warnings);
}

}  // namespace repose::vision
