#pragma once

#include <nlohmann/json.hpp>

#include "vision/film/film_facts.h"

namespace repose::cli {

inline nlohmann::ordered_json film_json(const vision::FilmFacts& film) {
  return {{"width", film.width},       {"height", film.height},
          {"frames", film.frames},     {"frames_per_s", film.frames_per_s},
          {"length_s", film.length_s}, {"dropped_frames", film.dropped_frames}};
}

}  // namespace repose::cli
