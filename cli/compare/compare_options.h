#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/compare/compare.h"
#include "vision/compare/heap_comparison.h"

namespace repose::cli {

/// The option with which each picture's boxes are left out.
inline constexpr std::array kExcludeOptions = {"--exclude-first", "--exclude-second"};

/// A `repose compare` that can be carried out.
struct ComparePlan {
  std::vector<std::filesystem::path> pictures;  ///< two
  std::array<vision::MeasureOptions, 2> measuring;
  vision::CompareOptions comparing;
  std::optional<double> grain_m;
  std::string overlay_file;
  std::string json_file;

  std::vector<std::string> errors;  ///< empty: it can be carried out
};

/// Reads and checks all that was typed, also whether the output can be written. All errors at once.
ComparePlan plan_compare(const CompareArguments& arguments);

}  // namespace repose::cli
