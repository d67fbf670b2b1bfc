#pragma once

#include <array>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "calibrate/compared/compared_sets.h"
#include "vision/compare/heap_comparison.h"

/// Words and units of a comparison, and two compared sets as JSON.
namespace repose::calibrate {

inline const char* name_of(vision::Agreement verdict) {
  switch (verdict) {
    case vision::Agreement::equivalent:
      return "equivalent";
    case vision::Agreement::different:
      return "different";
    case vision::Agreement::cannot_tell:
      break;
  }
  return "cannot tell";
}

inline const char* name_of(vision::Coverage cover) {
  switch (cover) {
    case vision::Coverage::whole:
      return "whole";
    case vision::Coverage::part:
      return "part";
    case vision::Coverage::none:
      break;
  }
  return "no";
}

inline const char* name_of(vision::LengthUnit unit) {
  switch (unit) {
    case vision::LengthUnit::metre:
      return "mm";
    case vision::LengthUnit::root_area:
      return "root_area";
    case vision::LengthUnit::height:
      break;
  }
  return "height";
}

/// Files hold mm, the program uses metres internally.
inline double shown_per_unit(vision::LengthUnit unit) {
  return unit == vision::LengthUnit::metre ? 1000 : 1;
}

/// Adds the keys of a difference in angles, for comparisons of two pictures and of two sets.
void add_angle_difference(nlohmann::ordered_json& json,
                          const std::optional<vision::AngleDifference>& angle);

/// The definition of both sets' angles.
nlohmann::ordered_json definition_json(const SetsPlan& plan);

/// The output of `repose compare --json` for two sets; see docs/json.md.
std::string sets_json(const ComparedSets& compared);

}  // namespace repose::calibrate
