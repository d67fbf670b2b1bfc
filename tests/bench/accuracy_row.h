#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/heap_conditions.h"
#include "vision/repose_angle.h"

namespace repose::bench {

struct SideErrors {
  std::optional<double> true_deg;
  std::optional<double> measured_deg;
  std::optional<double> uncertainty_deg;

  std::optional<double> error_deg() const;
  /// Whether the interval holds the truth.
  std::optional<bool> covered() const;
};

/// One picture, measured by one method.
struct Row {
  const testing::Condition* condition = nullptr;
  std::uint64_t seed = 0;
  std::string_view method;
  SideErrors mean;
  SideErrors left;
  SideErrors right;
  vision::MeasureStatus status = vision::MeasureStatus::refused;
  double confidence = 0;
  std::string segmentation;
  std::string warnings;  ///< codes, separated by spaces; the reason when refused
};

/// The methods that are compared: "auto", "paper", "script".
std::span<const std::string_view> methods();

/// Draws the condition's picture and measures it with each method; with a folder, writes overlays
/// of what was measured there.
std::vector<Row> measure_rows(const testing::Condition& condition, std::uint64_t seed,
                              std::span<const std::string_view> with_methods,
                              const std::string& overlay_folder = "");

void write_csv(const std::string& file, std::span<const Row> rows);

}  // namespace repose::bench
