#pragma once

#include <array>
#include <utility>

#include "vision/measure/repose_angle.h"

/// The words of the JSON and CSV files, which other programs read.
namespace repose::vision {

inline constexpr std::array<std::pair<MeasureStatus, const char*>, 3> kStatusNames = {
    {{MeasureStatus::ok, "ok"},
     {MeasureStatus::flagged, "flagged"},
     {MeasureStatus::refused, "refused"}}};

inline constexpr const auto& names_for(MeasureStatus) { return kStatusNames; }

inline const char* name_of(MeasureStatus status) {
  for (const auto& [known, name] : kStatusNames) {
    if (known == status) return name;
  }
  return "refused";
}

inline const char* name_of(FlankStatus status) {
  switch (status) {
    case FlankStatus::ok:
      return "ok";
    case FlankStatus::truncated:
      return "truncated";
    case FlankStatus::absent:
      break;
  }
  return "absent";
}

inline const char* name_of(Method method) { return method == Method::paper ? "paper" : "auto"; }

}  // namespace repose::vision
