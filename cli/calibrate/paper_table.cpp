#include "cli/calibrate/paper_table.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "calibrate/study/coefficients.h"
#include "cli/calibrate/calibrate_table.h"
#include "cli/common/terminal.h"

namespace repose::cli {
namespace {

using calibrate::PublishedHeap;
using calibrate::PublishedResult;

/// What the study file gives as a coefficient's value: that of an earlier calibration.
std::optional<double> earlier(const dem::Study& study, const std::string& name) {
  for (const calibrate::NamedCoefficient& named : calibrate::coefficients_of(study)) {
    if (named.name == name) return named.coefficient.value;
  }
  return std::nullopt;
}

std::string sweeps_text(const PublishedResult& published) {
  std::string text = fmt::format("{}{:>10}{:>10}{:>10}{:>8}\n", padded("sweep of", 34), "measured",
                                 "found", "runs", "R2");
  for (const calibrate::PublishedSweep& sweep : published.sweeps) {
    text += fmt::format("{}{:>10.2f}{:>10.4f}{:>10}{:>8.3f}{}\n",
                        padded(short_name(sweep.parameter), 34), sweep.measured, sweep.value,
                        sweep.levels.size(), sweep.r2, sweep.is_reached ? "" : "  not reached");
  }
  return text;
}

std::string heaps_text(const char* title, const std::vector<PublishedHeap>& heaps) {
  std::string text = fmt::format("\n{}\n{:>12}{:>10}{:>10}{:>12}{:>12}\n", title, "restitution",
                                 "sliding", "rolling", "angle [deg]", "error [%]");
  for (const PublishedHeap& heap : heaps) {
    text += fmt::format("{:>12.3f}{:>10.3f}{:>10.4f}", heap.coefficients[0], heap.coefficients[1],
                        heap.coefficients[2]);
    text += heap.angle_deg ? fmt::format("{:>12.2f}{:>12.2f}\n", *heap.angle_deg,
                                         heap.error_percent.value_or(0))
                           : fmt::format("{:>12}{:>12}\n", "–", "–");
  }
  return text;
}

std::string result_text(const PublishedResult& published, const dem::Study& study) {
  std::string text =
      fmt::format("\n{}{:>10}{:>16}\n", padded("coefficient", 36), "found", "study's value");
  for (const auto& [name, found] : published.values) {
    const auto value = earlier(study, name);
    text += fmt::format("{}{:>10.4f}{:>16}\n", padded(short_name(name), 36), found,
                        value ? fmt::format("{:.4f}", *value) : "–");
  }
  return text;
}

std::string check_text(const PublishedResult& published) {
  const calibrate::PublishedVerification& verification = published.verification;
  const double measured = verification.measured_deg;
  std::string text =
      fmt::format("\nsurface's least error {:.2f} %; heaps measured {:.2f} deg, simulated ",
                  published.least_error_percent, measured);
  if (!verification.mean_deg) return text + "none: no heap gave an angle\n";
  text += fmt::format("{:.2f} deg", *verification.mean_deg);
  if (verification.sd_deg) text += fmt::format(" sd {:.2f}", *verification.sd_deg);
  const auto heaps =
      std::count_if(verification.heaps.begin(), verification.heaps.end(),
                    [](const PublishedHeap& heap) { return heap.angle_deg.has_value(); });
  return text + fmt::format(" (n = {}), {:+.2f} % off\n", heaps,
                            100 * (*verification.mean_deg - measured) / measured);
}

}  // namespace

std::string paper_table(const PublishedResult& published, const dem::Study& study, int columns) {
  constexpr int kNarrowest = 40, kWidest = 100;
  std::string text = sweeps_text(published) +
                     heaps_text("steepest ascent", published.steepest_ascent) +
                     heaps_text("central composite design", published.composite) +
                     result_text(published, study) + check_text(published);
  const auto width = static_cast<std::size_t>(std::clamp(columns, kNarrowest, kWidest));
  for (const calibrate::SurfaceDiagnostic& diagnostic : published.warnings) {
    for (const std::string& line : wrapped("! " + diagnostic.message, width)) text += line + '\n';
  }
  const std::string advice =
      "These are single points without intervals, found one after the other: --method joint says "
      "what the measurements determine.";
  text += '\n';
  for (const std::string& line : wrapped(advice, width)) text += line + '\n';
  return text;
}

}  // namespace repose::cli
