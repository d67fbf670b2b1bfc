#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/subject.h"
#include "vision/measure/repose_angle.h"

namespace repose::bench {

struct SideErrors {
  std::optional<double> true_deg;
  std::optional<double> measured_deg;
  std::optional<double> uncertainty_deg;

  std::optional<double> error_deg() const;
  /// Whether the interval contains the truth.
  std::optional<bool> covered() const;
};

/// One picture, measured by one method.
struct Row {
  const Subject* subject = nullptr;
  std::string_view method;
  SideErrors mean;
  SideErrors left;
  SideErrors right;
  std::optional<double> seen_deg;  ///< mean angle of the exact outline in the picture
  vision::MeasureStatus status = vision::MeasureStatus::refused;
  double confidence = 0;
  std::string segmentation;
  std::string warnings;  ///< codes, separated by spaces; the reason when refused
};

/// The methods that are compared: "auto", "paper", "script".
std::span<const std::string_view> methods();

/// Takes the picture and measures it with each method; if a folder is given, writes overlays of the
/// measurements to it. The rows point to the subject.
std::vector<Row> measure_rows(const Subject& subject,
                              std::span<const std::string_view> with_methods,
                              const std::string& overlay_folder = "");

void write_csv(const std::string& file, std::span<const Row> rows);

}  // namespace repose::bench
