#pragma once

#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/common/degrees.h"
#include "vision/film/film_facts.h"
#include "vision/measure/repose_angle.h"

/// What the results of several commands have in common.
namespace repose::cli {

inline nlohmann::ordered_json or_null(const std::optional<double>& value) {
  if (!value) return nullptr;
  return *value;
}

inline nlohmann::ordered_json degrees(const std::optional<double>& angle_rad) {
  if (!angle_rad) return nullptr;
  return rounded_degrees(*angle_rad);
}

inline nlohmann::ordered_json film_json(const vision::FilmFacts& film) {
  return {{"width", film.width},       {"height", film.height},
          {"frames", film.frames},     {"frames_per_s", film.frames_per_s},
          {"length_s", film.length_s}, {"dropped_frames", film.dropped_frames}};
}

inline nlohmann::ordered_json warnings_json(const std::vector<vision::Warning>& warnings) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const vision::Warning& warning : warnings) {
    json.push_back({{"code", warning.code}, {"message", warning.message}});
  }
  return json;
}

}  // namespace repose::cli
