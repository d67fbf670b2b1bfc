#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "dem/study/study.h"

namespace repose::cli {

/// An experiment as users know it.
struct ExperimentName {
  dem::Experiment experiment;
  std::string_view name;
  std::string_view unit;
  std::string_view value;  ///< what is read
};

inline constexpr std::array<ExperimentName, 4> kExperiments = {{
    {dem::Experiment::drop, "drop", "mm", "rebound height"},
    {dem::Experiment::tilt, "tilt", "deg", "angle at which the grains slide"},
    {dem::Experiment::roll, "roll", "mm", "distance rolled along the flat"},
    {dem::Experiment::heap, "heap", "deg", "angle of repose"},
}};

inline const ExperimentName& names_of(dem::Experiment experiment) {
  return kExperiments[static_cast<std::size_t>(experiment)];
}

inline std::optional<dem::Experiment> experiment_named(std::string_view name) {
  for (const ExperimentName& known : kExperiments) {
    if (known.name == name) return known.experiment;
  }
  return std::nullopt;
}

}  // namespace repose::cli
