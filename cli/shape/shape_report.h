#pragma once

#include <optional>
#include <string>

#include "dem/shape/clump/clump_file.h"

namespace repose::cli {

/// The table for people.
std::string shape_table(const dem::ClumpFile& clump, std::optional<double> density_kg_m3,
                        int columns);

/// Everything, for programs.
std::string shape_json(const dem::ClumpFile& clump, std::optional<double> density_kg_m3);

}  // namespace repose::cli
