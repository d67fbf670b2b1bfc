#include "cli/calibrate/paper_report.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/statistics/summary.h"
#include "calibrate/study/coefficients.h"
#include "cli/calibrate/calibrate_json.h"
#include "cli/calibrate/calibrate_table.h"
#include "cli/common/terminal.h"
#include "cli/statistics/regress_json.h"
#include "cli/statistics/surface_report.h"

namespace repose::cli {
namespace {

using Json = nlohmann::ordered_json;
using calibrate::PublishedHeap;
using calibrate::PublishedOutcome;

std::optional<calibrate::Summary> angles_of(const std::vector<PublishedHeap>& heaps) {
  std::vector<double> angles;
  for (const PublishedHeap& heap : heaps) {
    if (heap.angle_deg) angles.push_back(*heap.angle_deg);
  }
  if (angles.empty()) return std::nullopt;
  return calibrate::summarise(angles);
}

/// What the study file gives as a coefficient's value: that of an earlier calibration.
std::optional<double> earlier(const dem::Study& study, const std::string& name) {
  for (const calibrate::NamedCoefficient& named : calibrate::coefficients_of(study)) {
    if (named.name == name) return named.coefficient.value;
  }
  return std::nullopt;
}

std::string sweeps_text(const PublishedOutcome& outcome) {
  std::string text = fmt::format("{}{:>10}{:>10}{:>10}{:>8}\n", padded("sweep of", 34), "measured",
                                 "found", "runs", "R2");
  for (const calibrate::PublishedSweep& sweep : outcome.sweeps) {
    text += fmt::format("{}{:>10.2f}{:>10.4f}{:>10}{:>8.3f}{}\n",
                        padded(short_name(sweep.parameter), 34), sweep.measured, sweep.value,
                        sweep.levels.size(), sweep.parabola.r2,
                        sweep.is_reached ? "" : "  not reached");
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

std::string result_text(const CalibratePlan& plan, const PublishedOutcome& outcome) {
  std::string text =
      fmt::format("\n{}{:>10}{:>16}\n", padded("coefficient", 36), "found", "study's value");
  for (std::size_t k = 0; k < outcome.values.size(); ++k) {
    const std::string& name = plan.problem.problem.parameters[k].name;
    const auto value = earlier(plan.record.study, name);
    text += fmt::format("{}{:>10.4f}{:>16}\n", padded(short_name(name), 36), outcome.values[k],
                        value ? fmt::format("{:.4f}", *value) : "–");
  }
  return text;
}

std::string check_text(const PublishedOutcome& outcome) {
  const auto angles = angles_of(outcome.verification);
  std::string text =
      fmt::format("\nsurface's least error {:.2f} %; heaps measured {:.2f} deg, simulated ",
                  outcome.optimum.value, outcome.measured_angle_deg);
  if (!angles) return text + "none: no heap gave an angle\n";
  text += fmt::format("{:.2f} deg", angles->mean);
  if (angles->sd) text += fmt::format(" sd {:.2f}", *angles->sd);
  return text + fmt::format(
                    " (n = {}), {:+.2f} % off\n", angles->n,
                    100 * (angles->mean - outcome.measured_angle_deg) / outcome.measured_angle_deg);
}

Json heaps_json(const std::vector<PublishedHeap>& heaps) {
  Json json = Json::array();
  for (const PublishedHeap& heap : heaps) {
    json.push_back(
        {{"restitution", heap.coefficients[0]},
         {"sliding_friction", heap.coefficients[1]},
         {"rolling_friction", heap.coefficients[2]},
         {"angle_deg", heap.angle_deg ? Json(*heap.angle_deg) : Json(nullptr)},
         {"error_percent", heap.error_percent ? Json(*heap.error_percent) : Json(nullptr)}});
  }
  return json;
}

Json sweeps_json(const PublishedOutcome& outcome) {
  Json json = Json::array();
  for (const calibrate::PublishedSweep& sweep : outcome.sweeps) {
    json.push_back({{"parameter", sweep.parameter},
                    {"observable", sweep.observable},
                    {"measured", sweep.measured},
                    {"levels", sweep.levels},
                    {"results", sweep.results},
                    {"value", sweep.value},
                    {"reached", sweep.is_reached},
                    {"r2", sweep.parabola.r2}});
  }
  return json;
}

}  // namespace

std::string paper_table(const CalibratePlan& plan, const PublishedOutcome& outcome, int columns) {
  constexpr int kNarrowest = 40, kWidest = 100;
  std::string text = sweeps_text(outcome) + heaps_text("steepest ascent", outcome.ascent) +
                     heaps_text("central composite design", outcome.composite) +
                     result_text(plan, outcome) + check_text(outcome);
  const auto width = static_cast<std::size_t>(std::clamp(columns, kNarrowest, kWidest));
  for (const calibrate::SurfaceDiagnostic& diagnostic : outcome.diagnostics) {
    for (const std::string& line : wrapped("! " + diagnostic.message, width)) text += line + '\n';
  }
  const std::string advice =
      "These are single points without intervals, found one after the other: --method joint says "
      "what the measurements determine.";
  text += '\n';
  for (const std::string& line : wrapped(advice, width)) text += line + '\n';
  return text;
}

namespace {

/// The surface of the error, without its runs: those are the composite design.
Json surface_json(const PublishedOutcome& outcome) {
  Json surface = Json::parse(regress_json(report_on(outcome.surface, std::nullopt)));
  surface.erase("runs");
  return surface;
}

}  // namespace

std::string paper_json(const CalibratePlan& plan, const PublishedOutcome& outcome) {
  Json values = Json::object();
  for (std::size_t k = 0; k < outcome.values.size(); ++k) {
    values[plan.problem.problem.parameters[k].name] = outcome.values[k];
  }
  const auto angles = angles_of(outcome.verification);
  Json diagnostics = Json::array();
  for (const calibrate::SurfaceDiagnostic& diagnostic : outcome.diagnostics) {
    diagnostics.push_back({{"code", diagnostic.code}, {"message", diagnostic.message}});
  }
  Json json{{"method", "paper"},
            {"values", values},
            {"sweeps", sweeps_json(outcome)},
            {"steepest_ascent", heaps_json(outcome.ascent)},
            {"composite", heaps_json(outcome.composite)},
            {"error_surface", surface_json(outcome)},
            {"least_error_percent", outcome.optimum.value},
            {"verification",
             {{"heaps", heaps_json(outcome.verification)},
              {"mean_deg", angles ? Json(angles->mean) : Json(nullptr)},
              {"sd_deg", angles && angles->sd ? Json(*angles->sd) : Json(nullptr)},
              {"measured_deg", outcome.measured_angle_deg}}},
            {"warnings", diagnostics},
            {"provenance", Json::parse(provenance_text(plan))}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::cli
