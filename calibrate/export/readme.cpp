#include "calibrate/export/readme.h"

#include <fmt/format.h>

#include "calibrate/export/target_entry.h"
#include "dem/contact/model_names.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"

namespace repose::calibrate {
namespace {

/// A text specific to the target, without its last line break.
std::string text_of(ExportTarget target, const char* name) {
  std::string text = filled(name_of(target) + '/' + name, {});
  if (!text.empty()) text.pop_back();
  return text;
}

/// Dampers are not multiples of the restitution that they produce.
std::string factor_text(const Conversion& conversion) {
  const bool is_same = conversion.exported == conversion.value;
  const bool is_damper = conversion.coefficient.ends_with("restitution") && !is_same;
  if (conversion.value == 0 || is_damper) return "no constant factor";
  return fmt::format("factor {:.4g}", conversion.exported / conversion.value);
}

void add_conversion(const Conversion& conversion, DeckFields& fields) {
  DeckFields& one = fields.add_section("CONVERSION");
  one.set("COEFFICIENT", conversion.coefficient);
  one.set("VALUE", fmt::format("{:.6g}", conversion.value));
  one.set("EXPORTED", fmt::format("{:.6g}", conversion.exported));
  one.set("FACTOR", factor_text(conversion));
  one.set("THEIR_NAME", conversion.target_name);
  one.set("OURS", conversion.ours);
  one.set("THEIRS", conversion.theirs);
  one.set("STANDING", name_of(conversion.fidelity));
  if (!conversion.limits.empty()) one.add_section("BUT").set("LIMITS", conversion.limits);
}

bool has_low_drop(const ExportFacts& facts) {
  return facts.has(dem::experiment_of<dem::DropProtocol>()) &&
         facts.study().protocol<dem::DropProtocol>().low_height_m.has_value();
}

void add_left_out(const ExportFacts& facts, ExportTarget target, DeckFields& fields) {
  std::string names;
  for (const dem::Experiment experiment : facts.left_out()) {
    names += (names.empty() ? "" : ", ") + name_of(experiment);
  }
  if (has_low_drop(facts) && !target->has_tables) {
    names += fmt::format("{}drop from low_height_mm", names.empty() ? "" : ", ");
  }
  if (!names.empty()) fields.add_section("LEFT_OUT").set("NAMES", names);
}

std::string heap_stiffness_text(const ExportFacts& facts) {
  if (!facts.has(dem::experiment_of<dem::HeapProtocol>())) return "The study has no heaps.";
  return fmt::format("Heaps, and their decks, have Young's moduli times {}.",
                     number(facts.stiffness(dem::experiment_of<dem::HeapProtocol>())));
}

/// Decks have grains of the mean size; EDEM has its own size distributions.
void add_sizes(const ExportFacts& facts, ExportTarget target, DeckFields& fields) {
  constexpr double kPercent = 100;
  const double percent = kPercent * facts.study().model.size_cv;
  if (percent == 0) return;
  DeckFields& sizes = fields.add_section("SIZES");
  sizes.set("PERCENT", percent);
  sizes.set("INSTEAD", target->has_tables ? "Choose a normal size distribution with this deviation."
                                          : "The grains of these decks all have the mean size.");
}

/// How a heap from the target program is measured and compared with the bench's.
void add_heap_back(const ExportFacts& facts, ExportTarget target, DeckFields& fields) {
  if (!facts.has(dem::experiment_of<dem::HeapProtocol>())) return;
  const std::string unit =
      target->heap_unit.empty() ? std::string() : fmt::format(" --unit {}", target->heap_unit);
  DeckFields& heap = fields.add_section("HEAP_BACK");
  heap.set_lines("SAVING", text_of(target, "heap_back.txt"));
  heap.set("FILE", std::string(target->heap_file));
  heap.set("UNIT", unit);
  heap.set("DEFINITION", heap_definition(facts));
}

void add_further_runs(const FurtherRuns& further, DeckFields& fields) {
  if (further.is_tilt_left_out) fields.add_section("TILT_LEFT_OUT");
  if (further.readings.empty()) return;
  DeckFields& runs = fields.add_section("FURTHER");
  runs.set("STUDY_FILE", kFurtherRunsFile);
  runs.set("COUNT", further.first_count());
  runs.set("MORE", further.next_count());
  runs.set("VARIED", further.parameters_text());
  for (const BenchMean& reading : further.readings) {
    DeckFields& one = runs.add_section("BENCH");
    one.set("EXPERIMENT", reading.experiment);
    one.set("MEAN", fmt::format("{:.4g}", reading.mean));
    one.set("UNCERTAINTY", fmt::format("{:.2g}", reading.uncertainty));
    one.set("READING_UNIT", reading.unit);
  }
}

/// Adds all sets, in our definitions.
void add_sets(const ExportFacts& facts, const ExportRequest& request,
              const std::vector<std::vector<double>>& sets, DeckFields& fields) {
  if (sets.size() < 2) return;
  DeckFields& all = fields.add_section("SETS");
  all.set("WRITTEN", static_cast<int>(request.set_number));
  all.set("COUNT", static_cast<int>(sets.size()));
  for (std::size_t k = 0; k < sets.size(); ++k) {
    DeckFields& one = all.add_section("SET");
    one.set("NUMBER", static_cast<int>(k + 1));
    for (std::size_t i = 0; i < sets[k].size(); ++i) {
      DeckFields& value = one.add_section("OF_SET");
      value.set("NAME", sanitized(facts.fitted().at(i).name));
      value.set("VALUE", fmt::format("{:.4g}", sets[k][i]));
    }
  }
}

}  // namespace

ExportedFile readme_of(const ExportFacts& facts, const ExportRequest& request,
                       const std::vector<Conversion>& conversions,
                       const std::vector<std::vector<double>>& sets, const FurtherRuns& further) {
  const ExportTarget target = request.target;
  DeckFields fields = common_fields(facts);
  add_sets(facts, request, sets, fields);
  fields.set("TARGET", target->program(facts.study().model.rolling));
  fields.set("ROLLING_MODEL", dem::name_of(facts.study().model.rolling));
  fields.set("SPHERES", static_cast<int>(facts.grain().spheres.size()));
  fields.set("HEAP_STIFFNESS", heap_stiffness_text(facts));
  fields.set_lines("RUNNING", text_of(target, "running.txt"));
  fields.set_lines("LIMITS", text_of(target, "limits.txt"));
  add_heap_back(facts, target, fields);
  add_further_runs(further, fields);
  add_left_out(facts, target, fields);
  add_sizes(facts, target, fields);
  for (const Conversion& conversion : conversions) add_conversion(conversion, fields);
  return {.name = "README.txt", .text = filled("readme.txt", fields)};
}

}  // namespace repose::calibrate
