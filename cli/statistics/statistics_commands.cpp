#include "cli/statistics/statistics_commands.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "cli/statistics/bench.h"
#include "cli/statistics/design.h"
#include "cli/statistics/regress.h"

namespace repose::cli {
namespace {

constexpr const char* kBenchNotes = R"(
READINGS are CSV tables with a row for each repeat and these columns:
  restitution  drop_mm, rebound_mm
  sliding      angle_deg
  rolling      incline_deg, released_mm (up it), stopped_mm (on the flat)
  density      mass_g, before_ml, after_ml
  young        force_n, spot_mm, height_mm, compression_mm
  poisson      height_mm, shortening_mm, width_mm, widening_mm
  size         length_mm, width_mm, thickness_mm
A column "sample" names the grain: repeats on one grain are averaged first. A
reading that is the same in all rows, or short lists, can be typed with --set.

Examples:
  repose bench sliding angles.csv
  repose bench restitution --set drop_mm=500 --set rebound_mm=9.1,9.6,9.4
)";

constexpr const char* kDesignNotes = R"(
Prints a CSV table with a row for each run: natural levels of each factor.
MIN and MAX are the coded levels -1 and 1.
  ccd          central composite: corners, axial points at alpha, centre runs;
               2 to 6 factors. Axial points lie outside MIN ... MAX, unless
               --inscribed or --alpha face
  box-behnken  three levels, no corners; 3 to 7 factors
  lhs          Latin hypercube, points far from each other; --seed
  sweep        one factor at a time, the others in the middle
  ascent       a straight line of runs: from --start by --step for each factor,
               or up the slope of a plane fitted to --fit TABLE.csv

Examples:
  repose design sweep --factor e=0.01:0.41 --levels 9
  repose design ccd --factor e=.1:.3 --factor mu=.1:.3 --random-order 1
  repose design ascent --start e=.1 --step e=.1 --start mu=.1 --step mu=.1
)";

constexpr const char* kRegressNotes = R"(
TABLE is a CSV table with a row for each run, a column for each factor and one
for the response. Without --factors, all columns but the response and those
that repose design adds (run, standard, point, NAME_coded) are factors.

Models: linear (1, A), interaction (and A*B), quadratic (and A^2). Factors are
coded: --coding says which levels are -1 and 1; otherwise a column that is
coded already is taken as it is, and any other by its lowest and highest level
(of the runs whose point is cube, if there are such).

Fit the measured quantity with its sign, not an error's absolute value, and
give the value that it should have as --target.

Example:
  repose regress runs.csv --response angle_deg --target 23.38
)";

void add_composite_options(CLI::App& design, DesignArguments& arguments) {
  design.add_option("--alpha", arguments.alpha, "ccd: axial points (rotatable)")
      ->option_text("WHERE|NUMBER");
  design.add_option("--centre", arguments.centre_runs, "ccd, box-behnken: centre runs")
      ->option_text("N");
  design.add_flag("--inscribed", arguments.is_inscribed, "ccd: nothing outside MIN ... MAX");
}

void add_ascent_options(CLI::App& design, DesignArguments& arguments) {
  design.add_option("--start", arguments.starts, "ascent: first level; repeatable")
      ->option_text("NAME=NUMBER")
      ->allow_extra_args(false);
  design.add_option("--step", arguments.steps, "ascent: by run; repeatable")
      ->option_text("NAME=NUMBER")
      ->allow_extra_args(false);
  design.add_option("--fit", arguments.fitted_table, "ascent: runs that were made")
      ->option_text("TABLE.csv");
  design.add_option("--response", arguments.response, "ascent: the table's response")
      ->option_text("COLUMN");
  design.add_option("--stride", arguments.stride, "ascent: coded step of --fit (0.5)")
      ->option_text("NUMBER");
  design.add_flag("--descend", arguments.descends, "ascent: down the slope of --fit");
}

}  // namespace

Command bench_command(CLI::App& app) {
  const auto given = std::make_shared<BenchArguments>();
  BenchArguments& arguments = *given;
  CLI::App* bench = app.add_subcommand("bench", "Work out bench tests from their readings");
  bench->add_option("test", arguments.test, "Which test")->option_text("TEST")->required();
  bench->add_option("readings", arguments.files, "Tables of readings")
      ->option_text("READINGS.csv ...");
  bench->add_option("--set", arguments.settings, "A reading, or several; repeatable")
      ->option_text("NAME=VALUE,...")
      ->allow_extra_args(false);
  bench->add_option("--json", arguments.json_file, "Everything, for programs")
      ->option_text("FILE|-");
  bench->footer(kBenchNotes);
  return {bench, [given] { return run_bench(*given); },
          "no test is named. Fix: repose bench sliding READINGS.csv; see repose bench --help."};
}

Command design_command(CLI::App& app) {
  const auto given = std::make_shared<DesignArguments>();
  DesignArguments& arguments = *given;
  CLI::App* design = app.add_subcommand("design", "Say which runs to make");
  design->add_option("kind", arguments.kind, "Kind of design")
      ->option_text("ccd|box-behnken|lhs|sweep|ascent")
      ->required();
  design->add_option("--factor", arguments.factors, "Factor and its range; repeatable")
      ->option_text("NAME=MIN:MAX")
      ->allow_extra_args(false);
  add_composite_options(*design, arguments);
  design->add_option("--runs", arguments.runs, "lhs (10 a factor), ascent (5): how many")
      ->option_text("N");
  design->add_option("--seed", arguments.seed, "lhs: other points (1)")->option_text("N");
  design->add_option("--levels", arguments.levels, "sweep: of each factor (9)")->option_text("N");
  add_ascent_options(*design, arguments);
  design->add_option("--random-order", arguments.random_order, "Runs in random order")
      ->option_text("SEED");
  design->add_flag("--coded", arguments.with_coded, "Coded levels too");
  design->add_option("--out", arguments.out_file, "Where the table goes (-)")
      ->option_text("FILE|-");
  design->footer(kDesignNotes);
  return {design, [given] { return run_design(*given); },
          "no kind of design is named. Fix: ccd, box-behnken, lhs, sweep or ascent."};
}

Command regress_command(CLI::App& app) {
  const auto given = std::make_shared<RegressArguments>();
  RegressArguments& arguments = *given;
  CLI::App* regress = app.add_subcommand("regress", "Fit a response surface to runs");
  regress->add_option("table", arguments.table, "The runs and their results")
      ->option_text("TABLE.csv")
      ->required();
  regress->add_option("--response", arguments.response, "Column to explain")
      ->option_text("COLUMN")
      ->required();
  regress->add_option("--factors", arguments.factors, "Columns to explain it by")
      ->option_text("A,B,C");
  regress->add_option("--model", arguments.model, "Terms (quadratic)")
      ->option_text("linear|interaction|quadratic");
  regress->add_option("--coding", arguments.codings, "Levels that are -1 and 1; repeatable")
      ->option_text("NAME=MIN:MAX")
      ->allow_extra_args(false);
  regress->add_option("--target", arguments.target, "Where does the response take this value?")
      ->option_text("VALUE");
  regress->add_option("--json", arguments.json_file, "Everything, for programs")
      ->option_text("FILE|-");
  regress->footer(kRegressNotes);
  return {regress, [given] { return run_regress(*given); },
          "a table and its response are needed. Fix: repose regress TABLE.csv --response COLUMN."};
}

}  // namespace repose::cli
