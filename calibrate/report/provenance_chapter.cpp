#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"

namespace repose::calibrate::report {
namespace {

void add(DataTable& data, const std::string& what, const std::string& value) {
  data.add({what, shortened(value, 280)});
}

std::string percent(double fraction) { return shown(100 * fraction, 2) + " %"; }

std::string by_experiment(const NamedValues& values, const char* unit) {
  std::string text;
  for (const auto& [experiment, value] : values) {
    if (!text.empty()) text += ", ";
    text += fmt::format("{} {}{}", shortened(experiment), shown(value), unit);
  }
  return text.empty() ? "–" : text;
}

/// "1 … 188"
std::string seeds_text(const std::vector<Run>& runs) {
  if (runs.empty()) return "–";
  const auto [least, greatest] = std::minmax_element(
      runs.begin(), runs.end(),
      [](const Run& one, const Run& other) { return one.job.seed < other.job.seed; });
  return fmt::format("{} … {}, one per simulation", least->job.seed, greatest->job.seed);
}

std::string settings_text(const std::vector<std::string>& settings) {
  std::string text;
  for (const std::string& setting : settings) text += "--set " + setting + ' ';
  return text.empty() ? "none" : text;
}

void add_study(const StudyIdentity& study, DataTable& data) {
  add(data, "program", study.program);
  add(data, "study file", study.file);
  add(data, "hash of the study", study.hash);
  add(data, "settings (--set)", settings_text(study.settings));
  add(data, "method", study.method);
  add(data, "budget", study.budget + ": " + study.budget_description);
}

void add_model(const StudyResult& result, DataTable& data) {
  const Provenance& from = result.provenance;
  add(data, "first seed", fmt::format("{}", from.first_seed));
  if (const auto* joint = std::get_if<JointResult>(&result.found)) {
    add(data, "seeds", seeds_text(joint->runs));
  }
  add(data, "contact model", from.contact_model);
  add(data, "damping", from.damping + ": " + from.damping_definition);
  add(data, "rolling friction", from.rolling_model + ": " + from.rolling_definition);
  add(data, "clump",
      fmt::format("{}, {} sphere{}", from.clump.source, from.clump.spheres,
                  from.clump.spheres == 1 ? "" : "s"));
  add(data, "clump volume error", percent(from.clump.volume_error));
  add(data, "clump inertia error", percent(from.clump.inertia_error));
  if (from.clump.size_sd_percent) {
    add(data, "standard deviation of sizes", fmt::format("{:.3g} %", *from.clump.size_sd_percent));
  }
  if (from.heap_definition) {
    add(data, "definition of a heap's angle", text_of(*from.heap_definition));
    const std::string simulated = simulated_text(*from.heap_definition);
    if (!simulated.empty()) add(data, "mean angle of the heaps simulated last", simulated);
  }
  if (!from.assumed.empty()) {
    add(data, "marked as assumed in the study", fmt::format("{}", fmt::join(from.assumed, ", ")));
  }
  add(data, "fraction of the real stiffness", by_experiment(from.stiffness_factor, ""));
  add(data, "shortest time step", by_experiment(from.shortest_timestep_s, " s"));
}

std::vector<std::string> warnings_of(const StudyResult& result) {
  if (const auto* joint = std::get_if<JointResult>(&result.found)) return joint->warnings;
  std::vector<std::string> warnings;
  for (const SurfaceDiagnostic& warning : std::get<PublishedResult>(result.found).warnings) {
    warnings.push_back(warning.message);
  }
  return warnings;
}

}  // namespace

Chapter provenance_chapter(const ReportedStudy& study) {
  Chapter chapter{.id = "provenance", .title = "Provenance", .blocks = {}};
  Table table{.name = "provenance",
              .title = {},
              .data = {.columns = {{.name = "item", .unit = {}}, {.name = "value", .unit = {}}},
                       .rows = {}}};
  if (study.study) add_study(*study.study, table.data);
  if (study.result) add_model(*study.result, table.data);
  const auto failed = std::count_if(study.runs.begin(), study.runs.end(),
                                    [](const SavedRun& run) { return !run.failure.empty(); });
  if (!study.runs.empty()) {
    add(table.data, "simulations",
        fmt::format("{}, of which {} failed", study.runs.size(), failed));
  }
  chapter.blocks.push_back(std::move(table));
  return chapter;
}

Chapter limits_chapter(const StudyResult& result) {
  Chapter chapter{.id = "limits", .title = "Limitations and warnings", .blocks = {}};
  for (const std::string& warning : warnings_of(result)) {
    chapter.blocks.push_back(Remark{shortened(warning, 1500)});
  }
  chapter.blocks.push_back(
      Remark{"Budget: " + shortened(result.provenance.study.budget_description, 1000) + "."});
  std::vector<const char*> limits = {
      "An interval is what these measurements allow if the model is right: it does not include "
      "errors of the contact model, the clump's shape or the bench procedure.",
      "Coefficients calibrated at reduced stiffness are valid only at that stiffness."};
  if (has_heap(result)) {
    limits.push_back(
        "A heap's angle hardly depends on restitution, and constrains only a combination of "
        "sliding "
        "and rolling friction between grains.");
  }
  for (const char* text : limits) chapter.blocks.push_back(Paragraph{text});
  return chapter;
}

}  // namespace repose::calibrate::report
