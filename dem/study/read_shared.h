#pragma once

#include <string>

#include "dem/study/section.h"
#include "dem/study/study.h"

/// Code shared with studies that are fitted to a table of another program's runs, and have
/// parameters instead of contact coefficients (calibrate/runs).
namespace repose::dem {

/// The section that marks a study of a table of runs.
inline constexpr const char* kTableSection = "parameter";

/// Reads title, author, date and note of [study]. Its other keys are left to the caller.
void read_heading(Section& section, StudyHeading& heading);

/// Allowed ranges of the numbers in { min = 0.1, max = 0.6 }.
struct BoundsRules {
  Range bounds;  ///< of min, max and value
  Range mean;    ///< of the prior mean
  Range widths;  ///< of sd and useful_half_width
};

/// { min = 0.1, max = 0.6, mean = 0.3, sd = 0.05, bounds = "known", useful_half_width = 0.05 }
/// @param whole the value as typed
/// @param example  a correct line
/// @param takes_value  a value, for runs made beforehand, is allowed
void read_bounds(Section bounds, const ConfigValue& whole, const BoundsRules& rules,
                 const std::string& example, bool takes_value, Coefficient& coefficient);

/// definition = "whole_flank": how an angle is measured; empty if not stated.
std::string read_definition(Section& section);

}  // namespace repose::dem
