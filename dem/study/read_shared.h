#pragma once

#include <string>

#include "dem/study/section.h"
#include "dem/study/study.h"

/// What a study has in common with one that is fitted to a table of runs of another program, and
/// has parameters in place of contact coefficients (calibrate/runs).
namespace repose::dem {

/// The section of a study that makes it one of a table of runs.
inline constexpr const char* kTableSection = "parameter";

/// [study]: title, author, date and note. Its other keys are still unknown.
void read_heading(Section& section, StudyHeading& heading);

/// What the numbers of { min = 0.1, max = 0.6 } may be.
struct BoundsRules {
  Range bounds;  ///< of both, and of a value between them
  Range mean;    ///< known beforehand
  Range widths;  ///< of sd and useful_half_width
};

/// { min = 0.1, max = 0.6, mean = 0.3, sd = 0.05, bounds = "known", useful_half_width = 0.05 }
/// @param whole    as it is typed
/// @param example  what a right line looks like
/// @param takes_value  it may have a value for runs made before
void read_bounds(Section bounds, const ConfigValue& whole, const BoundsRules& rules,
                 const std::string& example, bool takes_value, Coefficient& coefficient);

/// definition = "whole_flank": by what an angle is measured; empty: not said.
std::string read_definition(Section& section);

}  // namespace repose::dem
