#pragma once

#include <array>
#include <string>
#include <string_view>

/// What is called a heap's angle of repose: definitions whose numbers differ by degrees for the
/// same heap. All are of each flank, and then the mean of the two.
namespace repose::base {

struct AngleDefinition {
  std::string_view name;  ///< in study files, JSON and tables
  std::string_view description;
  std::array<double, 2> window;  ///< stretch of the flank, as fractions of the height
};

/// The one that is meant where none is named.
inline constexpr AngleDefinition kUsualDefinition = {
    "flank_20_80", "robust line at 20-80 % of the height, aprons weighed", {.2, .8}};

/// Least squares are ordinary ones, of height on distance.
inline constexpr std::array<AngleDefinition, 6> kAngleDefinitions = {
    {kUsualDefinition,
     {"height_over_base", "crest height over the base's half width (cone; ISO 4324)", {0, 1}},
     {"half_height_tangent", "least-squares tangent at 40-60 % of the height", {.4, .6}},
     {"inner_window", "least-squares line at 30-70 % of the height", {.3, .7}},
     {"outer_window", "least-squares line at 10-90 % of the height", {.1, .9}},
     {"whole_flank", "least-squares line from toe to crest", {0, 1}}}};

/// Null for a name that there is not.
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

/// Empty: none was named.
constexpr bool is_usual_definition(std::string_view name) {
  return name.empty() || name == kUsualDefinition.name;
}

/// The name of what is meant.
constexpr std::string_view definition_meant(std::string_view name) {
  return name.empty() ? kUsualDefinition.name : name;
}

}  // namespace repose::base
