#pragma once

#include <array>
#include <string>
#include <string_view>

/// Definitions of a heap's angle of repose; they differ by degrees for the same heap. Each is
/// evaluated per flank, then averaged over both.
namespace repose::base {

struct AngleDefinition {
  std::string_view name;  ///< in study files, JSON and tables
  std::string_view description;
  std::array<double, 2> window;  ///< stretch of the flank, as fractions of the height
};

/// The default if none is named.
inline constexpr AngleDefinition kUsualDefinition = {
    "flank_20_80", "robust line at 20-80 % of the height, aprons weighed", {.2, .8}};

/// Least squares are ordinary, height on distance.
inline constexpr std::array<AngleDefinition, 6> kAngleDefinitions = {
    {kUsualDefinition,
     {"height_over_base", "crest height over the base's half width (cone; ISO 4324)", {0, 1}},
     {"half_height_tangent", "least-squares tangent at 40-60 % of the height", {.4, .6}},
     {"inner_window", "least-squares line at 30-70 % of the height", {.3, .7}},
     {"outer_window", "least-squares line at 10-90 % of the height", {.1, .9}},
     {"whole_flank", "least-squares line from toe to crest", {0, 1}}}};

/// nullptr for an unknown name.
constexpr const AngleDefinition* find_definition(std::string_view name) {
  for (const AngleDefinition& definition : kAngleDefinitions) {
    if (definition.name == name) return &definition;
  }
  return nullptr;
}

/// All names, as a list.
inline std::string definition_names() {
  std::string names;
  for (const AngleDefinition& definition : kAngleDefinitions) {
    names += names.empty() ? "" : ", ";
    names += definition.name;
  }
  return names;
}

/// Also true for an empty name: none was given.
constexpr bool is_usual_definition(std::string_view name) {
  return name.empty() || name == kUsualDefinition.name;
}

/// The name itself, or the default's if it is empty.
constexpr std::string_view definition_meant(std::string_view name) {
  return name.empty() ? kUsualDefinition.name : name;
}

}  // namespace repose::base
