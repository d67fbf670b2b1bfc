#pragma once

#include <optional>

#include <nlohmann/json.hpp>

#include "cli/common/degrees.h"
#include "cli/compare/compare_names.h"

namespace repose::cli {

/// The keys of a difference of angles, in comparisons of two pictures and of two sets.
inline void add_angle_difference(nlohmann::ordered_json& json,
                                 const std::optional<vision::AngleDifference>& angle) {
  using Json = nlohmann::ordered_json;
  json["angle_difference_deg"] =
      angle ? Json(rounded_degrees(angle->difference_rad)) : Json(nullptr);
  json["angle_difference_interval"] =
      angle
          ? Json({rounded_degrees(angle->interval_rad[0]), rounded_degrees(angle->interval_rad[1])})
          : Json(nullptr);
  json["verdict"] = name_of(angle ? angle->verdict : vision::Agreement::cannot_tell);
}

}  // namespace repose::cli
