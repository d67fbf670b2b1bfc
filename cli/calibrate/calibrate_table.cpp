#include "cli/calibrate/calibrate_table.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "calibrate/result/result_text.h"
#include "cli/common/table.h"

namespace repose::cli {

std::string short_name(const std::string& coefficient) {
  constexpr std::string_view kPrefix = "contact.";
  return coefficient.starts_with(kPrefix) ? coefficient.substr(kPrefix.size()) : coefficient;
}

namespace {

/// "0.310", or as many digits as a quantity of that size needs.
std::string four_digits(double value) {
  if (!std::isfinite(value)) return kMissing;
  const double size = std::abs(value);
  const double shown = size < .0005 ? 0 : value;  // no "-0.000"
  return fmt::format("{:.{}f}", shown, size < 10 ? 3 : size < 100 ? 2 : 1);
}

Table parameters_table(const calibrate::JointResult& joint) {
  Table table({{.heading = "coefficient"},
               number_column("value"),
               {.heading = "95 % interval"},
               {.heading = "verdict"}});
  for (const calibrate::ResultParameter& parameter : joint.parameters) {
    table.add_row({short_name(parameter.name), four_digits(parameter.value),
                   fmt::format("{} … {}", four_digits(parameter.interval.low),
                               four_digits(parameter.interval.high)),
                   name_of(parameter.verdict)});
    const std::string condition = condition_text(joint, parameter);
    if (!condition.empty()) {
      table.add_note(kNoteIndent, fmt::format("{} {}, which was assumed",
                                              name_of(parameter.verdict), condition));
    }
  }
  return table;
}

std::string pair(double value, double uncertainty) {
  return fmt::format("{} ± {}", four_digits(value), four_digits(uncertainty));
}

Table observables_table(const calibrate::JointResult& joint) {
  Table table({{.heading = "observable"},
               number_column("measured"),
               number_column("simulated"),
               number_column("difference / σ"),
               {.heading = "verdict"}});
  for (const calibrate::ResultObservable& observable : joint.observables) {
    const calibrate::Agreement& checked = *observable.verification;
    table.add_row(
        {observable.unit.empty() ? observable.name
                                 : fmt::format("{} [{}]", observable.name, observable.unit),
         pair(observable.measured, observable.measured_uncertainty),
         pair(checked.simulated, checked.simulated_uncertainty),
         std::isfinite(checked.difference_sigma) ? fmt::format("{:+.1f}", checked.difference_sigma)
                                                 : kMissing,
         name_of(checked.verdict)});
  }
  return table;
}

/// The systematic part of differences.
void add_systematic(const calibrate::JointResult& joint, Page& page) {
  for (const calibrate::ResultObservable& observable : joint.observables) {
    const std::string shared = systematic_text(observable);
    if (shared.empty()) continue;
    page.add(fmt::format("({}: its readings share {})", observable.name, shared));
  }
  if (const std::string model = model_error_text(joint); !model.empty()) {
    page.add(fmt::format("({})", model));
  }
  if (const std::string coarse = coarse_text(joint); !coarse.empty()) {
    page.add(fmt::format("({})", coarse));
  }
}

/// The coefficients if the readings' scatter differed from what was assumed.
void add_assumed_scatter(const calibrate::JointResult& joint, Page& page) {
  if (joint.assumed_scatters.readings.empty()) return;
  Table table({{.heading = "coefficient"},
               {.heading = "scatter"},
               {.heading = "95 % interval"},
               {.heading = "verdict"}});
  for (const calibrate::ScatterDependence& one : joint.assumed_scatters.coefficients) {
    for (const auto& [scatter, moved] :
         {std::pair("half", &one.half), std::pair("twice", &one.twice)}) {
      table.add_row({short_name(one.name), scatter,
                     fmt::format("{} … {}", four_digits(moved->interval.low),
                                 four_digits(moved->interval.high)),
                     name_of(moved->verdict)});
    }
  }
  std::string readings;
  for (const calibrate::AssumedScatter& one : joint.assumed_scatters.readings) {
    readings += fmt::format("{}{} {:.2g} %", readings.empty() ? "" : ", ", one.observable,
                            100 * one.fraction);
  }
  page.add_gap();
  page.add(table);
  page.add(
      fmt::format("(fitted again with half and twice the scatter of single readings that was "
                  "assumed, as nobody "
                  "measured it: {})",
                  readings));
}

/// Values from surfaces through the runs, if nothing was simulated again.
void add_fitted(const calibrate::JointResult& joint, Page& page) {
  Table table({{.heading = "observable"},
               number_column("measured"),
               number_column("by the surface"),
               number_column("difference / σ")});
  for (const calibrate::ResultObservable& one : joint.observables) {
    table.add_row({one.unit.empty() ? one.name : fmt::format("{} [{}]", one.name, one.unit),
                   pair(one.measured, one.measured_uncertainty),
                   pair(one.simulated, one.simulated_uncertainty),
                   fmt::format("{:+.1f}", one.difference_sigma)});
  }
  page.add_gap();
  page.add("Not checked in simulations; what surfaces through the table's runs give:");
  page.add(table);
  if (const std::string freedom = freedom_text(joint); !freedom.empty()) {
    page.add(fmt::format("({})", freedom));
  }
  page.add("(± is the standard uncertainty of the mean)");
}

/// For each experiment that does not agree, what would decide it.
void add_agreement(const calibrate::JointResult& joint, Page& page) {
  if (!joint.verdict) {
    add_fitted(joint, page);
    return;
  }
  page.add_gap();
  page.add(
      joint.is_of_table
          ? std::string("Run again at the fitted values, with fresh seeds that the fit has not "
                        "seen:")
          : fmt::format("Simulated with fresh seeds in {}:",
                        joint.agreement.rounds == 1
                            ? "1 round"
                            : fmt::format("{} rounds", joint.agreement.rounds)));
  page.add(observables_table(joint));
  if (const std::string freedom = freedom_text(joint); !freedom.empty()) {
    page.add(fmt::format("({})", freedom));
  }
  page.add("(± is the standard uncertainty of the mean)");
  for (const calibrate::ResultObservable& observable : joint.observables) {
    if (observable.verification->verdict == calibrate::AgreementVerdict::agrees) continue;
    page.add(fmt::format("{}: {}.", observable.name,
                         agreement_text(*observable.verification, observable.unit)));
  }
}

/// Held-out readings, as predicted by the fit.
void add_predictions(const calibrate::JointResult& joint, Page& page) {
  if (joint.held_out.empty()) return;
  Table table({{.heading = "held out"},
               number_column("measured"),
               number_column("predicted"),
               {.heading = "95 % interval"},
               number_column("difference / σ"),
               {.heading = "verdict"}});
  for (const calibrate::Prediction& prediction : joint.held_out) {
    table.add_row({prediction.unit.empty()
                       ? prediction.name
                       : fmt::format("{} [{}]", prediction.name, prediction.unit),
                   pair(prediction.measured, prediction.measured_uncertainty),
                   pair(prediction.predicted, prediction.uncertainty),
                   fmt::format("{} … {}", four_digits(prediction.interval.low),
                               four_digits(prediction.interval.high)),
                   std::isfinite(prediction.difference_sigma)
                       ? fmt::format("{:+.1f}", prediction.difference_sigma)
                       : kMissing,
                   name_of(prediction.verdict)});
  }
  page.add_gap();
  page.add(table);
  for (const calibrate::Prediction& prediction : joint.held_out) {
    page.add(prediction_text(prediction) + '.');
  }
  page.add(
      !joint.is_of_table
          ? fmt::format("(not fitted: predicted by simulations at {} sets of coefficients that "
                        "the fit leaves plausible)",
                        calibrate::kDrawnSets)
          : std::string("(not fitted: predicted by surfaces through the table's runs, at sets "
                        "of coefficients that the fit leaves plausible)"));
}

/// Wording for the check of an assumed input.
struct SensitivityWords {
  std::string readings;      ///< heading of the readings: "stiffer grains"
  std::string input;         ///< heading of the simulated value: "factor"
  std::string explanation;   ///< meaning of a change
  std::string coefficients;  ///< heading of the coefficients
};

/// The effect of another value of an assumed input.
void add_sensitivity(const std::vector<calibrate::SensitivityCheck>& readings,
                     const std::vector<calibrate::MovedCoefficient>& coefficients,
                     const SensitivityWords& words, Page& page) {
  if (readings.empty()) return;
  Table table({{.heading = words.readings},
               number_column(words.input),
               number_column("change"),
               {.heading = "95 % interval"},
               number_column("limit"),
               {.heading = "verdict"}});
  for (const calibrate::SensitivityCheck& check : readings) {
    table.add_row(
        {check.unit.empty() ? check.name : fmt::format("{} [{}]", check.name, check.unit),
         fmt::format("{:.3g}", check.value), four_digits(check.change),
         fmt::format("{} … {}", four_digits(check.interval.low), four_digits(check.interval.high)),
         four_digits(check.limit), name_of(check.verdict)});
  }
  page.add_gap();
  page.add(table);
  page.add(fmt::format(
      "({}, at the coefficients checked last; limit: the half-width of the 95 % interval of the "
      "bench's mean)",
      words.explanation));
  if (const std::string coarse = larger_grains_text(readings); !coarse.empty()) {
    page.add(fmt::format("({})", coarse));
  }
  if (coefficients.empty()) return;
  Table moved({{.heading = words.coefficients},
               number_column("value"),
               {.heading = "95 % interval"},
               {.heading = "verdict"}});
  for (const calibrate::MovedCoefficient& one : coefficients) {
    moved.add_row(
        {short_name(one.name), four_digits(one.value),
         fmt::format("{} … {}", four_digits(one.interval.low), four_digits(one.interval.high)),
         name_of(one.verdict)});
  }
  page.add_gap();
  page.add(moved);
  page.add(
      "(what the same readings ask for where those changes are taken into account, with their "
      "uncertainty)");
}

/// The remaining uncertainty from softening.
void add_stiffness(const calibrate::JointResult& joint, Page& page) {
  add_sensitivity(joint.stiffness_checks, joint.stiffer_coefficients,
                  {.readings = "stiffer grains",
                   .input = "factor",
                   .explanation = "what a larger stiffness_factor changes in a reading",
                   .coefficients = "coefficient with stiffer grains"},
                  page);
}

/// The remaining uncertainty from the number of spheres, or why it is unknown.
void add_shape(const calibrate::JointResult& joint, Page& page) {
  if (!joint.shape_check) return;  // result of an earlier version
  const calibrate::ShapeCheck& shape = *joint.shape_check;
  add_sensitivity(
      shape.readings, shape.coefficients,
      {.readings = "more spheres",
       .input = "spheres",
       .explanation = fmt::format("what more spheres than {} change in a reading", shape.spheres),
       .coefficients = "coefficient with more spheres"},
      page);
  const std::string open = shape_check_text(shape);
  if (open.empty()) return;
  page.add_gap();
  page.add(open);
}

/// The effect of inputs held fixed: those that shift a coefficient by a quarter of its
/// half-interval.
void add_inputs(const calibrate::JointResult& joint, Page& page) {
  if (joint.with_assumed.empty()) return;
  constexpr double kMatters = .25;
  Table table({{.heading = "what we assumed"},
               {.heading = "moves"},
               number_column("by"),
               number_column("half-width")});
  bool is_any = false;
  for (const calibrate::InputEffect& input : joint.assumed_inputs) {
    for (std::size_t j = 0; j < input.coefficients.size(); ++j) {
      const double half = joint.with_assumed[j].half_width;
      if (!(std::abs(input.coefficients[j].change) > kMatters * half)) continue;
      table.add_row({fmt::format("{} {:.4g} ± {:.3g} {}{}", input.input, input.value, input.sd,
                                 input.unit, input.is_assumed ? " (assumed)" : ""),
                     short_name(input.coefficients[j].name),
                     fmt::format("{:+.2g}", input.coefficients[j].change), four_digits(half)});
      is_any = true;
    }
  }
  page.add_gap();
  if (is_any) {
    page.add(table);
    page.add(
        "(the input larger by its standard uncertainty; others move no coefficient by more than a "
        "quarter of the half-width of its 95 % interval)");
  } else {
    page.add(
        "What was held fixed, varied within its own uncertainty, moves no coefficient by more than "
        "a quarter of the half-width of its 95 % interval.");
  }
  std::string with;
  for (const calibrate::CombinedEffect& one : joint.with_assumed) {
    with += fmt::format("{}{} {} … {}", with.empty() ? "" : ", ", short_name(one.name),
                        four_digits(one.interval.low), four_digits(one.interval.high));
  }
  page.add(fmt::format("With all that was assumed (95 %): {}.", with));
}

/// "μs wall" for "contact.particle_wall.sliding_friction"; "e grain" between grains.
std::string symbol_of(const std::string& coefficient) {
  const std::string name = short_name(coefficient);
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return name;
  const std::string what = name.substr(dot + 1);
  std::string with = name.substr(0, dot);
  if (with == "particle_particle") with = "grain";
  if (with.starts_with("particle_")) with.erase(0, std::string_view("particle_").size());
  for (const auto& [known, symbol] :
       {std::pair("restitution", "e"), {"sliding_friction", "μs"}, {"rolling_friction", "μr"}}) {
    if (what == known) return fmt::format("{} {}", symbol, with);
  }
  return name;
}

/// Whole sets, if coefficients are not determined individually.
void add_sets(const calibrate::JointResult& joint, Page& page) {
  const std::vector<calibrate::EquivalentSet> sets = good_sets(joint);
  if (sets.size() < 2 || !has_open_coefficients(joint)) return;
  std::vector<Column> columns = {number_column("set")};
  for (const calibrate::ResultParameter& parameter : joint.parameters) {
    columns.push_back(number_column(symbol_of(parameter.name)));
  }
  if (joint.verdict) columns.push_back({.heading = "simulated"});
  Table table(std::move(columns));
  for (std::size_t k = 0; k < sets.size(); ++k) {
    std::vector<std::string> cells = {fmt::format("{}", k + 1)};
    for (const double value : sets[k].values) cells.push_back(four_digits(value));
    if (joint.verdict) cells.push_back(sets[k].verdict ? name_of(*sets[k].verdict) : kMissing);
    table.add_row(std::move(cells));
  }
  page.add_gap();
  page.add(fmt::format("Equally good sets, the best one first. {}", calibrate::kUseOneRow));
  page.add(table);
  if (joint.is_of_table) return;
  page.add(
      "(e restitution, μs sliding friction, μr rolling friction; of a grain with the wall, or with "
      "another grain; repose export writes set 1, or another with --set-number)");
}

void add_advice(const calibrate::JointResult& joint, Page& page) {
  std::set<std::string> told;
  for (const calibrate::ResultParameter& parameter : joint.parameters) {
    if (parameter.advice.empty()) continue;
    const std::string line = fmt::format("{} is {}: {}", short_name(parameter.name),
                                         name_of(parameter.verdict), parameter.advice);
    if (!told.insert(line).second) continue;
    page.add_gap();
    page.add(line);
  }
}

/// Verdicts that depend on a bound.
void add_bounds(const calibrate::JointResult& joint, Page& page) {
  bool is_first = true;
  for (const calibrate::ResultParameter& parameter : joint.parameters) {
    const std::string text = bounds_text(parameter);
    if (text.empty()) continue;
    if (is_first) page.add_gap();
    is_first = false;
    page.add(fmt::format("{}: {}.", short_name(parameter.name), text));
  }
}

void add_additions(const calibrate::JointResult& joint, Page& page) {
  if (joint.additions.empty()) return;
  page.add_gap();
  page.add(!joint.is_of_table ? "For the study file (repose plan tells what each would give):"
                              : "For the study file, with a table of what the bench read:");
  for (const calibrate::StudyAddition& addition : joint.additions) {
    page.add_gap();
    page.add_lines(addition.lines);
  }
}

/// The definition by which heaps were measured.
void add_heap_definition(const calibrate::Provenance& provenance, Page& page) {
  if (!provenance.model || !provenance.model->heap_definition) return;
  const calibrate::HeapDefinition& definition = *provenance.model->heap_definition;
  page.add_gap();
  const std::string simulated = simulated_text(definition);
  page.add(fmt::format(
      "Angles of heaps are by the definition {}.{}{}", text_of(definition),
      simulated.empty() ? "" : " The simulated heaps have " + simulated + '.',
      definition.is_assumed
          ? " If the bench's angle is by another, state it: definition = ... in [experiment.heap]."
          : ""));
}

/// Differences if another program than ours made the runs.
void add_simulator(const calibrate::Provenance& provenance, Page& page) {
  if (!provenance.model || !provenance.model->simulator) return;
  const calibrate::SimulatorFacts& simulator = *provenance.model->simulator;
  page.add_gap();
  page.add(fmt::format("Simulated by {}. Other than in our own engine: {}", simulator.name,
                       fmt::join(simulator.differences, " ")));
}

/// Values marked as not measured in the study.
void add_assumed(const calibrate::Provenance& provenance, Page& page) {
  if (provenance.assumed.empty()) return;
  page.add_gap();
  page.add(
      fmt::format("Assumed in the study, not measured: {}.", fmt::join(provenance.assumed, ", ")));
}

/// The counts that `calibrate` found in the table.
std::string table_text(const calibrate::TableFacts& table) {
  return fmt::format(
      "These parameters are valid for the program, particles and settings that the {} runs of {} "
      "were made with ({} failed, {} without a reading; {} rows were left out).",
      table.rows, fmt::join(table.files, ", "), table.failed, table.without_reading,
      table.left_out);
}

std::string belongs_to_text(const calibrate::Provenance& provenance) {
  if (provenance.table) return table_text(*provenance.table);
  const calibrate::ModelFacts& of = *provenance.model;
  std::string stiffness;
  for (const auto& [experiment, factor] : of.stiffness_factor) {
    stiffness += fmt::format("{}{} {:g}", stiffness.empty() ? "" : ", ", experiment, factor);
  }
  const calibrate::ClumpFacts& clump = of.clump;
  return fmt::format(
      "These coefficients are valid for: {}{}, damping {} ({}), rolling friction {} ({}); a clump "
      "of "
      "{} ({}, volume error {:+.2f} %){}; stiffness factor {}; budget {}: {}.",
      of.simulator ? of.simulator->name + ", " : "", of.contact_model, of.damping,
      of.damping_definition, of.rolling_model, of.rolling_definition,
      clump.spheres == 1 ? "1 sphere" : fmt::format("{} spheres", clump.spheres), clump.source,
      100 * clump.volume_error,
      clump.size_sd_percent
          ? fmt::format(", in bulks of sizes with a standard deviation of {:.3g} %",
                        *clump.size_sd_percent)
          : "",
      stiffness, provenance.study.budget, provenance.study.budget_description);
}

}  // namespace

std::string joint_table(const calibrate::JointResult& joint,
                        const calibrate::Provenance& provenance, int columns) {
  Page page(std::min(columns, kWidestText));
  for (const std::string& sentence : summary_sentences(joint)) page.add(sentence);
  add_sets(joint, page);
  page.add_gap();
  page.add(parameters_table(joint));
  add_bounds(joint, page);
  add_predictions(joint, page);
  add_agreement(joint, page);
  add_systematic(joint, page);
  add_assumed_scatter(joint, page);
  add_stiffness(joint, page);
  add_shape(joint, page);
  add_inputs(joint, page);
  add_advice(joint, page);
  add_additions(joint, page);
  add_heap_definition(provenance, page);
  add_assumed(provenance, page);
  add_simulator(provenance, page);
  page.add_gap();
  page.add(belongs_to_text(provenance));
  return page.text();
}

}  // namespace repose::cli
