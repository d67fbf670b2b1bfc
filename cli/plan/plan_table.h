#pragma once

#include <string>

#include "calibrate/plan/plan.h"

namespace repose::cli {

/// A plan as a readable table.
std::string plan_table(const calibrate::Plan& plan, const calibrate::OfferedStudy& offered,
                       int terminal_columns);

}  // namespace repose::cli
