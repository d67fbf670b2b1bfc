#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/units.h"
#include "vision/film/film_file.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

/// Common parts of the JSON of several kinds of results.

namespace repose {

/// For files: more digits than any camera resolves, without the noise of the conversion.
inline double rounded_degrees(double angle_rad) {
  return std::round(to_degrees(angle_rad) * 1e6) / 1e6;
}

inline nlohmann::ordered_json places_json(const std::vector<vision::Point>& places) {
  auto json = nlohmann::ordered_json::array();
  for (const vision::Point& place : places) json.push_back({place.x, place.y});
  return json;
}

/// [x, y, width, height]; null if there is none.
inline nlohmann::ordered_json box_json(const std::optional<vision::Box>& box) {
  if (!box) return nullptr;
  return nlohmann::ordered_json::array({box->x, box->y, box->width, box->height});
}

inline nlohmann::ordered_json boxes_json(const std::vector<vision::Box>& boxes) {
  auto json = nlohmann::ordered_json::array();
  for (const vision::Box& box : boxes) json.push_back(box_json(box));
  return json;
}

/// [x1, y1, x2, y2]; null if there is none.
inline nlohmann::ordered_json line_json(const std::optional<vision::Segment>& line) {
  if (!line) return nullptr;
  return nlohmann::ordered_json::array({line->from.x, line->from.y, line->to.x, line->to.y});
}

/// A list as text of a JSON array.
/// @param json_of  makes an object of each
template <typename Item, typename JsonOf>
std::string json_text(const std::vector<Item>& items, const JsonOf& json_of) {
  using Json = nlohmann::ordered_json;
  Json json = Json::array();
  for (const Item& item : items) json.push_back(json_of(item));
  constexpr int kIndent = 2;
  // File names need not be UTF-8, but JSON must be.
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

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

}  // namespace repose
