#include "cli/statistics/design.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/csv.h"
#include "base/input_error.h"
#include "calibrate/statistics/design/design.h"
#include "calibrate/statistics/regress/run_table.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/statistics/statistics_commands.h"

namespace repose::cli {

namespace {

struct DesignCsvOptions {
  bool with_coded = false;     ///< a column NAME_coded for each factor
  bool with_standard = false;  ///< the number in standard order, besides that in the table
};

/// Short, without the rounding of the last bits: 0.3, not 0.30000000000000004.
std::string level_text(double level) {
  const std::string text = fmt::format("{:.12g}", level);
  return text == "-0" ? "0" : text;
}

/// Values that are only rounding errors relative to the factor's range become 0.
double without_rounding(double natural, const calibrate::Factor& factor) {
  constexpr double kRounding = 1e-14;
  const double size = std::abs(factor.low) + std::abs(factor.high);
  return std::abs(natural) < kRounding * size ? 0 : natural;
}

/// A row for each run: its number, type of point, and each factor's natural level.
std::string design_csv(const calibrate::Design& design, const DesignCsvOptions& options) {
  std::vector<std::string> header = {"run"};
  if (options.with_standard) header.emplace_back("standard");
  header.emplace_back("point");
  for (const calibrate::Factor& factor : design.factors) header.push_back(factor.name);
  if (options.with_coded) {
    for (const calibrate::Factor& factor : design.factors) header.push_back(factor.name + "_coded");
  }
  std::string csv = base::csv_row(header);
  int number = 0;
  for (const calibrate::DesignRun& run : design.runs) {
    std::vector<std::string> cells = {fmt::format("{}", ++number)};
    if (options.with_standard) cells.push_back(fmt::format("{}", run.standard));
    cells.push_back(name_of(run.kind));
    for (std::size_t i = 0; i < design.factors.size(); ++i) {
      const calibrate::Factor& factor = design.factors[i];
      cells.push_back(level_text(without_rounding(factor.natural(run.coded[i]), factor)));
    }
    if (options.with_coded) {
      for (const double level : run.coded) cells.push_back(level_text(level));
    }
    csv += base::csv_row(cells);
  }
  return csv;
}

/// A `repose design` that can be carried out.
struct DesignPlan {
  calibrate::Design design;
  DesignCsvOptions csv;
  std::string out_file;  ///< "-" without --out

  std::vector<std::string> notes;
  std::vector<std::string> errors;  ///< empty: it can be carried out
};

using calibrate::Factor;

constexpr int kUsualCentreRuns = 6;

constexpr int kUsualLevels = 9;

constexpr int kUsualSteps = 5;

/// Which options a kind of design understands.
struct Kind {
  std::string_view name;
  std::vector<std::string_view> options;
};

const std::array<Kind, 5> kKinds = {{
    {"ccd", {"--factor", "--alpha", "--centre", "--inscribed"}},
    {"box-behnken", {"--factor", "--centre"}},
    {"lhs", {"--factor", "--runs", "--seed"}},
    {"sweep", {"--factor", "--levels"}},
    {"ascent",
     {"--start", "--step", "--runs", "--fit", "--response", "--factor", "--stride", "--descend"}},
}};

/// The typed options, among those that not every kind has.
std::vector<std::string_view> typed_options(const DesignArguments& given) {
  const std::vector<std::pair<std::string_view, bool>> typed = {
      {"--factor", !given.factors.empty()},
      {"--alpha", !given.alpha.empty()},
      {"--centre", !given.centre_runs.empty()},
      {"--inscribed", given.is_inscribed},
      {"--runs", !given.runs.empty()},
      {"--levels", !given.levels.empty()},
      {"--seed", !given.seed.empty()},
      {"--start", !given.starts.empty()},
      {"--step", !given.steps.empty()},
      {"--fit", !given.fitted_table.empty()},
      {"--response", !given.response.empty()},
      {"--stride", !given.stride.empty()},
      {"--descend", given.descends}};
  std::vector<std::string_view> names;
  for (const auto& [name, is_typed] : typed) {
    if (is_typed) names.push_back(name);
  }
  return names;
}

void check_kind(const DesignArguments& arguments, DesignPlan& plan) {
  std::vector<std::string> names;
  for (const Kind& known : kKinds) names.emplace_back(known.name);
  const auto found = read_word({"design", arguments.kind, plan.errors}, names);
  if (!found) return;
  const Kind& kind = kKinds[*found];
  for (const std::string_view option : typed_options(arguments)) {
    if (std::find(kind.options.begin(), kind.options.end(), option) != kind.options.end()) continue;
    plan.errors.push_back(
        fmt::format("{}: not an option of {}. Fix: leave it out.", option, kind.name));
  }
}

/// Up to a million, of either sign: the design itself checks which numbers are valid.
int count_or(int otherwise, const char* option, const std::string& text, DesignPlan& plan) {
  constexpr int kMax = 1'000'000;
  return read_whole_number({option, text, plan.errors}, -kMax, kMax, fmt::format("{} 3", option))
      .value_or(otherwise);
}

void check_name(const char* option, const std::string& text, const std::string& name,
                DesignPlan& plan) {
  const std::set<std::string_view> taken = {"run", "standard", "point"};
  if (!taken.contains(name) && !name.ends_with("_coded")) return;
  plan.errors.push_back(
      fmt::format("{} {}: {} is the name of another column of the table. Fix: choose another name.",
                  option, text, name));
}

std::vector<Factor> read_factors(const DesignArguments& arguments, DesignPlan& plan) {
  std::vector<Factor> factors;
  for (const std::string& text : arguments.factors) {
    const auto factor = factor_in("--factor", text, plan.errors);
    if (!factor) continue;
    check_name("--factor", text, factor->name, plan);
    factors.push_back(*factor);
  }
  return factors;
}

calibrate::CompositeOptions composite_options(const DesignArguments& arguments, DesignPlan& plan) {
  calibrate::CompositeOptions options;
  options.centre_runs = count_or(kUsualCentreRuns, "--centre", arguments.centre_runs, plan);
  options.is_inscribed = arguments.is_inscribed;
  if (arguments.alpha.empty() || arguments.alpha == "rotatable") return options;
  if (arguments.alpha == "orthogonal") {
    options.rule = calibrate::AxialRule::orthogonal;
  } else if (arguments.alpha == "face") {
    options.rule = calibrate::AxialRule::face;
  } else if (const auto alpha = parse_number<double>(arguments.alpha)) {
    options.alpha = alpha;
  } else {
    plan.errors.push_back(
        fmt::format("--alpha {}: must be rotatable, orthogonal, face or a number. Fix: leave it "
                    "out for rotatable.",
                    arguments.alpha));
  }
  return options;
}

/// From --start and --step.
calibrate::Design typed_line(const DesignArguments& arguments, int runs, DesignPlan& plan) {
  std::vector<std::string> names;
  std::vector<double> start, step;
  for (const std::string& text : arguments.starts) {
    if (const auto named = named_number_in("--start", text, plan.errors)) {
      check_name("--start", text, named->first, plan);
      names.push_back(named->first);
      start.push_back(named->second);
    }
  }
  step.resize(names.size(), 0.0);
  for (const std::string& text : arguments.steps) {
    const auto named = named_number_in("--step", text, plan.errors);
    if (!named) continue;
    const auto found = std::find(names.begin(), names.end(), named->first);
    if (found == names.end()) {
      plan.errors.push_back(fmt::format("--step {}: {} has no start. Fix: add --start {}=NUMBER.",
                                        text, named->first, named->first));
    } else {
      step[static_cast<std::size_t>(found - names.begin())] = named->second;
    }
  }
  if (!plan.errors.empty()) return {};
  return calibrate::line_of_runs(names, start, step, runs);
}

/// From the runs of an earlier design.
calibrate::Design fitted_line(const DesignArguments& arguments, const std::vector<Factor>& codings,
                              int runs, DesignPlan& plan) {
  constexpr double kUsualStride = .5;
  const double stride =
      read_number({"--stride", arguments.stride, plan.errors}, "a number", "--stride 0.5")
          .value_or(kUsualStride);
  if (arguments.response.empty()) {
    plan.errors.emplace_back("--fit: the response is not named. Fix: add --response COLUMN.");
  }
  if (!plan.errors.empty()) return {};
  const calibrate::TableOfRuns table =
      calibrate::runs_in(calibrate::read_table(arguments.fitted_table),
                         {.response = arguments.response, .codings = codings});
  for (const calibrate::LeftOut& one : table.left_out) {
    plan.notes.push_back(
        fmt::format("{}: {} is left out ({})", arguments.fitted_table, one.what, one.why));
  }
  plan.notes.insert(plan.notes.end(), table.notes.begin(), table.notes.end());
  const calibrate::Regression plane =
      calibrate::regress(table.runs, calibrate::SurfaceModel::linear);
  constexpr double kSignificant = .05;
  if (plane.explained.p.value_or(0) > kSignificant) {
    plan.notes.push_back(fmt::format(
        "{}: the plane explains no more than chance would (p = {:.2g}): this direction is a guess.",
        arguments.fitted_table, *plane.explained.p));
  }
  return calibrate::steepest_ascent(plane, runs, stride, arguments.descends);
}

calibrate::Design ascent(const DesignArguments& arguments, const std::vector<Factor>& factors,
                         DesignPlan& plan) {
  const int runs = count_or(kUsualSteps, "--runs", arguments.runs, plan);
  const bool is_typed = !arguments.starts.empty() || !arguments.steps.empty();
  if (is_typed == !arguments.fitted_table.empty()) {
    plan.errors.emplace_back(
        "ascent: the direction must be given in one way. Fix: --start and --step for each factor, "
        "or --fit TABLE.csv --response COLUMN.");
    return {};
  }
  return is_typed ? typed_line(arguments, runs, plan) : fitted_line(arguments, factors, runs, plan);
}

calibrate::Design make_design(const DesignArguments& arguments, DesignPlan& plan) {
  const std::vector<Factor> factors = read_factors(arguments, plan);
  if (arguments.kind == "ascent") return ascent(arguments, factors, plan);
  const calibrate::CompositeOptions composite = composite_options(arguments, plan);
  const std::optional<int> centre =
      arguments.centre_runs.empty() ? std::nullopt : std::optional(composite.centre_runs);
  const int levels = count_or(kUsualLevels, "--levels", arguments.levels, plan);
  // Ten runs for each factor: Loeppky, Sacks, Welch (2009), Technometrics 51, 366.
  constexpr int kRunsForEach = 10;
  const int runs =
      count_or(kRunsForEach * static_cast<int>(factors.size()), "--runs", arguments.runs, plan);
  const auto seed = read_seed({"--seed", arguments.seed, plan.errors}).value_or(1);
  if (!plan.errors.empty()) return {};
  if (arguments.kind == "ccd") return calibrate::central_composite(factors, composite);
  if (arguments.kind == "box-behnken") return calibrate::box_behnken(factors, centre);
  if (arguments.kind == "lhs") return calibrate::latin_hypercube(factors, runs, seed);
  return calibrate::sweep(factors, levels);
}

/// Axial points and ascents leave the given range, and few quantities here can be negative.
void note_negative_levels(DesignPlan& plan) {
  for (std::size_t i = 0; i < plan.design.factors.size(); ++i) {
    const Factor& factor = plan.design.factors[i];
    double least = 0;
    for (const calibrate::DesignRun& run : plan.design.runs) {
      least = std::min(least, factor.natural(run.coded[i]));
    }
    const double rounding = 1e-12 * std::abs(factor.high);
    if (std::min(factor.low, factor.high) < 0 || least >= -rounding) continue;
    plan.notes.push_back(
        fmt::format("{}: some runs have a level below 0 ({:.4g}). If that is impossible, choose "
                    "another range, or --inscribed or --alpha face for a ccd.",
                    factor.name, least));
  }
}

/// Reads and checks all arguments, and makes the design. Reports all errors at once.
DesignPlan plan_design(const DesignArguments& arguments) {
  DesignPlan plan;
  plan.out_file = arguments.out_file.empty() ? std::string(kStandardOutput) : arguments.out_file;
  plan.csv = {.with_coded = arguments.with_coded, .with_standard = !arguments.random_order.empty()};
  check_kind(arguments, plan);
  const auto order_seed =
      read_seed({"--random-order", arguments.random_order, plan.errors}).value_or(1);
  try {
    plan.design = make_design(arguments, plan);
  } catch (const base::InputError& error) {
    add_faults(error, plan.errors);
  }
  // A table to which results were added has another header.
  const std::string csv = design_csv(plan.design, plan.csv);
  const std::string header = csv.substr(0, csv.find('\n') + 1);
  check_output_places({csv_place("--out", arguments.out_file, header)}, {arguments.fitted_table},
                      plan.errors);
  if (!plan.errors.empty()) return plan;
  if (!arguments.random_order.empty()) calibrate::randomise_order(plan.design, order_seed);
  note_negative_levels(plan);
  return plan;
}

}  // namespace

ExitCode run_design(const DesignArguments& arguments) {
  const DesignPlan plan = plan_design(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  print_lines(plan.notes);
  Outputs outputs;
  outputs.add(plan.out_file, design_csv(plan.design, plan.csv));
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
