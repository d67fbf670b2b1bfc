#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"

namespace repose::calibrate::report {
namespace {

void add(DataTable& data, const std::string& what, const std::string& value) {
  data.add({what, shortened(value, 280)});
}

std::string percent(const JsonView& fraction) {
  const auto value = fraction.number();
  return value ? shown(100 * *value, 2) + " %" : "–";
}

std::string by_experiment(const JsonView& object, const char* unit) {
  std::string text;
  for (const auto& [experiment, value] : object.members()) {
    if (!text.empty()) text += ", ";
    text += fmt::format("{} {}{}", shortened(experiment), shown(value.number()), unit);
  }
  return text.empty() ? "–" : text;
}

/// "1 … 188"
std::string seeds_text(const JsonView& runs) {
  std::optional<double> least, greatest;
  for (const JsonView& run : runs.items()) {
    const auto seed = run["seed"].number();
    if (!seed) continue;
    least = std::min(least.value_or(*seed), *seed);
    greatest = std::max(greatest.value_or(*seed), *seed);
  }
  if (!least) return "–";
  return fmt::format("{:.0f} … {:.0f}, one for each simulation of an experiment", *least,
                     *greatest);
}

std::string settings_text(const JsonView& settings) {
  std::string text;
  for (const JsonView& setting : settings.items()) text += "--set " + setting.text() + ' ';
  return text.empty() ? "none" : text;
}

}  // namespace

Chapter provenance_chapter(const StudyFolder& study) {
  Chapter chapter{.id = "provenance", .title = "Where the numbers come from", .blocks = {}};
  Table table{.name = "provenance",
              .title = {},
              .data = {.columns = {{.name = "what", .unit = {}}, {.name = "value", .unit = {}}},
                       .rows = {}}};
  DataTable& data = table.data;
  const JsonView from = study.is_finished() ? study.result["provenance"] : study.study;
  add(data, "program", from["program"].shown());
  add(data, "study file", from["study"]["file"].shown());
  add(data, "hash of the study", from["study"]["hash"].shown());
  add(data, "settings laid over it", settings_text(from["study"]["settings"]));
  add(data, "method", study.is_paper_way() ? "paper" : "joint");
  add(data, "budget",
      from["budget"]["name"].shown() + ": " + from["budget"]["description"].shown());
  if (study.is_finished()) {
    add(data, "first seed", from["first_seed"].shown());
    if (study.result["runs"].exists()) add(data, "seeds", seeds_text(study.result["runs"]));
    add(data, "contact model", from["contact_model"].shown());
    add(data, "rolling friction",
        from["rolling_model"].shown() + ": " + from["rolling_definition"].shown());
    const JsonView clump = from["clump"];
    add(data, "clump", clump["source"].shown() + ", " + clump["spheres"].shown() + " spheres");
    add(data, "clump's error of volume", percent(clump["volume_error"]));
    add(data, "clump's error of inertia", percent(clump["inertia_error"]));
    add(data, "share of the real stiffness", by_experiment(from["stiffness_factor"], ""));
    add(data, "shortest time step", by_experiment(from["shortest_timestep_s"], " s"));
  }
  std::size_t failed = 0;
  for (const SavedRun& run : study.runs) failed += run.failure.empty() ? 0 : 1;
  if (!study.runs.empty()) {
    add(data, "simulations", fmt::format("{}, {} of them failed", study.runs.size(), failed));
  }
  chapter.blocks.push_back(std::move(table));
  return chapter;
}

Chapter limits_chapter(const StudyFolder& study) {
  Chapter chapter{.id = "limits", .title = "Limits and warnings", .blocks = {}};
  for (const JsonView& warning : study.result["warnings"].items()) {
    const std::string text =
        warning["message"].exists() ? warning["message"].text() : warning.text();
    if (!text.empty()) chapter.blocks.push_back(Remark{shortened(text, 1500)});
  }
  const std::string budget = study.result["provenance"]["budget"]["description"].text();
  if (!budget.empty()) chapter.blocks.push_back(Remark{"Budget: " + shortened(budget, 1000) + "."});
  for (const char* text :
       {"An interval says what these measurements allow if the simulation can be right at all: "
        "errors of the contact model, of the clump's shape and of the protocol on the bench are "
        "not in it.",
        "Coefficients found at a lower stiffness than the real one belong to that stiffness.",
        "A heap's angle hardly tells restitution, and tells sliding and rolling friction between "
        "grains together, not one by one."}) {
    chapter.blocks.push_back(Paragraph{text});
  }
  return chapter;
}

}  // namespace repose::calibrate::report
