#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "vision/picture/picture.h"

namespace repose::cli {

inline nlohmann::ordered_json places_json(const std::vector<vision::Point>& places) {
  auto json = nlohmann::ordered_json::array();
  for (const vision::Point& place : places) json.push_back({place.x, place.y});
  return json;
}

/// A list as the text of a JSON array.
/// @param json_of  makes an object of each
template <typename Item, typename JsonOf>
std::string json_text(const std::vector<Item>& items, const JsonOf& json_of) {
  using Json = nlohmann::ordered_json;
  Json json = Json::array();
  for (const Item& item : items) json.push_back(json_of(item));
  constexpr int kIndent = 2;
  // File names need not be UTF-8, JSON must be.
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::cli
