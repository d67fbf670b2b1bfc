#include "cli/statistics/statistics_commands.h"

#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "calibrate/statistics/bench/bench.h"
#include "calibrate/statistics/bench/sheet.h"
#include "cli/common/option_value.h"
#include "cli/statistics/bench.h"
#include "cli/statistics/design.h"
#include "cli/statistics/regress.h"
#include "dem/experiment/experiment_table.h"

namespace repose::cli {

namespace {

/// Whether a name is valid as a table column without quotes, and as a factor in a model's terms.
bool is_plain_name(std::string_view name) {
  return !name.empty() && name.find_first_of(" ,;:\"\t\r\n*^") == std::string_view::npos;
}

}  // namespace

std::optional<calibrate::Factor> factor_in(const std::string& option, const std::string& text,
                                           std::vector<std::string>& errors) {
  const std::size_t equals = text.find('=');
  const std::size_t colon = text.find(':', equals == std::string::npos ? 0 : equals);
  if (equals != std::string::npos && colon != std::string::npos) {
    const auto low =
        parse_number<double>(std::string_view(text).substr(equals + 1, colon - equals - 1));
    const auto high = parse_number<double>(std::string_view(text).substr(colon + 1));
    const std::string name = text.substr(0, equals);
    if (low && high && *low < *high && is_plain_name(name)) {
      return calibrate::Factor{name, *low, *high};
    }
  }
  errors.push_back(fmt::format(
      "{0} {1}: must be a name without blanks and two levels, the lower one first. Fix: "
      "{0} friction=0.1:0.3.",
      option, text));
  return std::nullopt;
}

std::optional<std::pair<std::string, double>> named_number_in(const std::string& option,
                                                              const std::string& text,
                                                              std::vector<std::string>& errors) {
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos) {
    const auto number = parse_number<double>(std::string_view(text).substr(equals + 1));
    const std::string name = text.substr(0, equals);
    if (number && is_plain_name(name)) return std::pair(name, *number);
  }
  errors.push_back(fmt::format(
      "{0} {1}: must be a name without blanks and a number. Fix: {0} friction=0.1.", option, text));
  return std::nullopt;
}

namespace {

constexpr const char* kBenchTests = R"(
READINGS are CSV tables with a row for each repeat and these columns:
  restitution     drop_mm, rebound_mm; diameter_mm and density_kg_m3, in_air
  sliding         angle_deg
  rolling         incline_deg, released_mm (up it), stopped_mm (on the flat);
                  diameter_mm
  density         mass_g, before_ml, after_ml
  young           force_n, spot_mm, height_mm, compression_mm
  poisson         height_mm, shortening_mm, width_mm, widening_mm
  size            length_mm, width_mm, thickness_mm
  drop_on_grains  drop_mm, rebound_mm; in_air
  pendulum        release_deg, swing_deg
)";

constexpr const char* kBenchNotes =
    R"(Columns after a semicolon are optional. A grain's diameter and density correct
a drop for air drag (in_air=0: the heights are already free of it), a ball's
diameter corrects for what it loses at the foot of the incline.

A column "sample" names the grain: repeats on one grain are averaged first. A
reading that is the same in all rows, or a short list, can be given with --set.

Examples:
  repose bench sliding angles.csv
  repose bench restitution --set drop_mm=500 --set rebound_mm=9.1,9.6,9.4
  repose bench rolling rolls.csv --set diameter_mm=20
)";

/// The tests of experiments, and alternative names of experiments.
std::string experiment_tests() {
  std::string lines, names;
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    const std::string_view test = entry.sheet.test;
    if (entry.sheet.mean) {
      const auto columns = calibrate::column_names(calibrate::bench_test_named(test));
      lines += fmt::format("  {:<14}  {}\n", test, fmt::join(columns, ", "));
    }
    if (entry.name == test) continue;
    const bool is_first = names.empty();
    names += fmt::format("{}{} {} {}", is_first ? "" : ", ", entry.name,
                         is_first ? "stands for" : "for", test);
  }
  return fmt::format("{}{}.\n", lines, names);
}

constexpr const char* kDesignNotes = R"(
Prints a CSV table with one row per run: the level of each factor in its own
unit. MIN and MAX are the coded levels -1 and 1.
  ccd          central composite: corners, axial points at alpha, centre runs;
               2 to 6 factors. Axial points lie outside MIN ... MAX, unless
               --inscribed or --alpha face
  box-behnken  three levels, no corners; 3 to 7 factors
  lhs          Latin hypercube with well-separated points; --seed
  sweep        one factor at a time, the others in the middle
  ascent       a straight line of runs: from --start by --step for each factor,
               or up the gradient of a plane fitted to --fit TABLE.csv

Examples:
  repose design sweep --factor e=0.01:0.41 --levels 9
  repose design ccd --factor e=.1:.3 --factor mu=.1:.3 --random-order 1
  repose design ascent --start e=.1 --step e=.1 --start mu=.1 --step mu=.1
)";

constexpr const char* kRegressNotes = R"(
TABLE is a CSV table with one row per run, a column for each factor and one for
the response. Without --factors, all columns are factors but the response and
the bookkeeping of a design (order of runs, kind of point, NAME_coded, remarks).
Columns that are not used are listed.

Runs of different days or batches may be shifted as a whole: --blocks names the
column that distinguishes them. A text column, or one called block, is used
unless --blocks none is given.

Models: linear (1, A), interaction (and A*B), quadratic (and A^2). Factors are
coded: --coding gives the levels coded as -1 and 1; otherwise a column that is
already coded is used as it is, and any other is coded by its lowest and highest
level (among the runs whose point is cube, if any).

Fit the measured quantity with its sign, not the absolute value of an error.
Give the value it should have as --target; if that is uncertain, add the
half-width of its 95 % interval after ± (or +-).

Example:
  repose regress runs.csv --response angle_deg --target 23.38
)";

}  // namespace

Command bench_command() {
  const auto given = std::make_shared<BenchArguments>();
  return {
      .name = "bench",
      .summary = "Evaluate bench tests from their readings",
      .options = {{"test", "TEST", "Bench test", &given->test, true},
                  {"readings", "READINGS.csv ...", "Tables of readings", &given->files},
                  {"--set", "NAME=VALUE,...", "One or more readings; repeatable", &given->settings},
                  {"--json", "FILE|-", "Full results, for programs", &given->json_file}},
      .notes = kBenchTests + experiment_tests() + kBenchNotes,
      .missing = "no test given. Fix: repose bench sliding READINGS.csv; see repose bench --help.",
      .run = [given] { return run_bench(*given); }};
}

Command design_command() {
  const auto given = std::make_shared<DesignArguments>();
  return {.name = "design",
          .summary = "Design a set of simulation runs",
          .options =
              {{"kind", "ccd|box-behnken|lhs|sweep|ascent", "Kind of design", &given->kind, true},
               {"--factor", "NAME=MIN:MAX", "Factor and its range; repeatable", &given->factors},
               {"--alpha", "WHERE|NUMBER", "ccd: axial points (rotatable)", &given->alpha},
               {"--centre", "N", "ccd, box-behnken: centre runs", &given->centre_runs},
               {"--inscribed", "", "ccd: no run outside MIN ... MAX", &given->is_inscribed},
               {"--runs", "N", "Runs: lhs (10 per factor), ascent (5)", &given->runs},
               {"--seed", "N", "lhs: random seed (1)", &given->seed},
               {"--levels", "N", "sweep: levels of each factor (9)", &given->levels},
               {"--start", "NAME=NUMBER", "ascent: first level; repeatable", &given->starts},
               {"--step", "NAME=NUMBER", "ascent: step per run; repeatable", &given->steps},
               {"--fit", "TABLE.csv", "ascent: table of runs already made", &given->fitted_table},
               {"--response", "COLUMN", "ascent: response column of the table", &given->response},
               {"--stride", "NUMBER", "ascent: coded step of --fit (0.5)", &given->stride},
               {"--descend", "", "ascent: descend instead", &given->descends},
               {"--random-order", "SEED", "Randomise the order of the runs", &given->random_order},
               {"--coded", "", "Also write coded levels", &given->with_coded},
               {"--out", "FILE|-", "Output file (-)", &given->out_file}},
          .notes = kDesignNotes,
          .missing = "no kind of design given. Fix: ccd, box-behnken, lhs, sweep or ascent.",
          .run = [given] { return run_design(*given); }};
}

Command regress_command() {
  const auto given = std::make_shared<RegressArguments>();
  return {
      .name = "regress",
      .summary = "Fit a response surface to runs",
      .options = {{"table", "TABLE.csv", "Runs and their results", &given->table, true},
                  {"--response", "COLUMN", "Response column", &given->response, true},
                  {"--factors", "A,B,C", "Factor columns", &given->factors},
                  {"--blocks", "COLUMN|none", "Column of blocks of runs", &given->blocks},
                  {"--model", "linear|interaction|quadratic", "Model (quadratic)", &given->model},
                  {"--coding", "NAME=MIN:MAX", "Levels coded as -1 and 1; repeatable",
                   &given->codings},
                  {"--target", "VALUE[±U]", "Find where the response has this value",
                   &given->target},
                  {"--json", "FILE|-", "Full results, for programs", &given->json_file}},
      .notes = kRegressNotes,
      .missing =
          "a table and its response are needed. Fix: repose regress TABLE.csv --response COLUMN.",
      .run = [given] { return run_regress(*given); }};
}

}  // namespace repose::cli
