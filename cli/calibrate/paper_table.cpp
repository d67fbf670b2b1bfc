#include "cli/calibrate/paper_table.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "calibrate/study/study_simulator.h"
#include "cli/calibrate/calibrate_table.h"
#include "cli/common/table.h"

namespace repose::cli {
namespace {

using calibrate::PublishedHeap;
using calibrate::PublishedResult;

/// A coefficient's value in the study file, from an earlier calibration.
std::optional<double> earlier(const dem::Study& study, const std::string& name) {
  for (const calibrate::NamedCoefficient& named : calibrate::coefficients_of(study)) {
    if (named.name == name) return named.coefficient.value;
  }
  return std::nullopt;
}

Table sweeps_table(const PublishedResult& published) {
  Table table({{.heading = "sweep of"},
               number_column("measured"),
               number_column("found"),
               number_column("runs"),
               number_column("R2"),
               {}});
  for (const calibrate::PublishedSweep& sweep : published.sweeps) {
    table.add_row({short_name(sweep.parameter), fmt::format("{:.2f}", sweep.measured),
                   fmt::format("{:.4f}", sweep.value), std::to_string(sweep.levels.size()),
                   fmt::format("{:.3f}", sweep.r2), sweep.is_reached ? "" : "not reached"});
  }
  return table;
}

Table heaps_table(const std::vector<PublishedHeap>& heaps) {
  Table table({number_column("restitution"), number_column("sliding"), number_column("rolling"),
               number_column("angle [deg]"), number_column("error [%]")});
  for (const PublishedHeap& heap : heaps) {
    table.add_row(
        {fmt::format("{:.3f}", heap.coefficients[0]), fmt::format("{:.3f}", heap.coefficients[1]),
         fmt::format("{:.4f}", heap.coefficients[2]),
         heap.angle_deg ? fmt::format("{:.2f}", *heap.angle_deg) : kMissing,
         heap.angle_deg ? fmt::format("{:.2f}", heap.error_percent.value_or(0)) : kMissing});
  }
  return table;
}

Table values_table(const PublishedResult& published, const dem::Study& study) {
  Table table({{.heading = "coefficient"}, number_column("found"), number_column("study's value")});
  for (const auto& [name, found] : published.values) {
    const auto value = earlier(study, name);
    table.add_row({short_name(name), fmt::format("{:.4f}", found),
                   value ? fmt::format("{:.4f}", *value) : kMissing});
  }
  return table;
}

std::string check_text(const PublishedResult& published) {
  const calibrate::PublishedVerification& verification = published.verification;
  const double measured = verification.measured_deg;
  std::string text =
      fmt::format("minimum error of the surface {:.2f} %; heaps measured {:.2f} deg, simulated ",
                  published.least_error_percent, measured);
  if (!verification.mean_deg) return text + "none: no heap gave an angle";
  text += fmt::format("{:.2f} deg", *verification.mean_deg);
  if (verification.sd_deg) text += fmt::format(" sd {:.2f}", *verification.sd_deg);
  const auto heaps =
      std::count_if(verification.heaps.begin(), verification.heaps.end(),
                    [](const PublishedHeap& heap) { return heap.angle_deg.has_value(); });
  return text + fmt::format(" (n = {}), {:+.2f} % off", heaps,
                            100 * (*verification.mean_deg - measured) / measured);
}

}  // namespace

std::string paper_table(const PublishedResult& published, const dem::Study& study, int columns) {
  Page page(std::min(columns, kWidestText));
  page.add(sweeps_table(published));
  page.add_gap();
  page.add("steepest ascent");
  page.add(heaps_table(published.steepest_ascent));
  page.add_gap();
  page.add("central composite design");
  page.add(heaps_table(published.composite));
  page.add_gap();
  page.add(values_table(published, study));
  page.add_gap();
  page.add(check_text(published));
  for (const calibrate::SurfaceDiagnostic& diagnostic : published.warnings) {
    page.add("! ", diagnostic.message);
  }
  page.add_gap();
  page.add(
      "These are point estimates without intervals, found one after the other: --method joint "
      "shows "
      "what the measurements determine.");
  return page.text();
}

}  // namespace repose::cli
