#include "cli/statistics/regress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.h"
#include "calibrate/result/surface_summary.h"
#include "calibrate/statistics/left_out.h"
#include "calibrate/statistics/regress/run_table.h"
#include "calibrate/statistics/regress/surface_report.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"
#include "cli/statistics/statistics_commands.h"

namespace repose::cli {

namespace {

/// An evaluated `repose regress`, before its output.
struct RegressPlan {
  calibrate::SurfaceModel model = calibrate::SurfaceModel::quadratic;
  std::optional<calibrate::WantedValue> target;
  std::string json_file;
  calibrate::SurfaceReport report;
  std::vector<calibrate::LeftOut> left_out;
  std::vector<std::string> notes;

  std::vector<std::string> errors;  ///< empty: it can be carried out
};

constexpr std::array kRegressFields{base::FieldName{"linear model", "--model linear"},
                                    base::FieldName{"blocks column", "--blocks"},
                                    base::FieldName{"choose no blocks", "--blocks none"},
                                    base::FieldName{"factor columns", "--factors A,B,C"},
                                    base::FieldName{"target value", "--target"}};

std::vector<std::string> names_in(const std::string& text, RegressPlan& plan) {
  std::vector<std::string> names;
  if (text.empty()) return names;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    names.push_back(text.substr(start, end - start));
    if (names.back().empty()) {
      plan.errors.push_back(fmt::format(
          "--factors {}: must be columns with commas between them. Fix: --factors e,mu.", text));
      return {};
    }
    start = end + 1;
  }
  return names;
}

/// "VALUE" or "VALUE±U", also typed "VALUE+-U".
std::optional<calibrate::WantedValue> read_target(const std::string& text,
                                                  std::vector<std::string>& errors) {
  constexpr std::array<std::string_view, 2> kSigns = {"±", "+-"};
  std::string value = text, uncertainty;
  for (const std::string_view sign : kSigns) {
    const std::size_t at = text.find(sign);
    if (at == std::string::npos) continue;
    value = text.substr(0, at);
    uncertainty = text.substr(at + sign.size());
  }
  const auto wanted = parse_number<double>(value);
  const auto spread =
      uncertainty.empty() && value == text ? 0.0 : parse_number<double>(uncertainty).value_or(-1);
  if (wanted && spread >= 0) return calibrate::WantedValue{*wanted, spread};
  if (text.empty()) return std::nullopt;
  OptionText{"--target", text, errors}.refuse(
      "a number, or one with the half-width of its 95 % interval behind ±",
      "--target 23.4 or --target 23.38±0.23");
  return std::nullopt;
}

/// Reads all arguments and the table they name, and fits the surface. Reports all errors at once.
RegressPlan plan_regress(const RegressArguments& arguments) {
  RegressPlan plan;
  plan.json_file = arguments.json_file;
  using calibrate::SurfaceModel;
  plan.model = read_choice<SurfaceModel>({"--model", arguments.model, plan.errors},
                                         {{"linear", SurfaceModel::linear},
                                          {"interaction", SurfaceModel::interaction},
                                          {"quadratic", SurfaceModel::quadratic}})
                   .value_or(plan.model);
  const std::vector<std::string> factors = names_in(arguments.factors, plan);
  std::vector<calibrate::Factor> codings;
  for (const std::string& text : arguments.codings) {
    if (const auto coding = factor_in("--coding", text, plan.errors)) codings.push_back(*coding);
  }
  plan.target = read_target(arguments.target, plan.errors);
  check_output_places({json_place(plan.json_file, "\"coefficients\"")}, {arguments.table},
                      plan.errors);
  try {
    calibrate::TableOfRuns table =
        calibrate::runs_in(calibrate::read_table(arguments.table), {.response = arguments.response,
                                                                    .factors = factors,
                                                                    .blocks = arguments.blocks,
                                                                    .codings = codings,
                                                                    .names = kRegressFields});
    plan.left_out = std::move(table.left_out);
    plan.notes = std::move(table.notes);
    plan.report =
        report_on(calibrate::regress(table.runs, plan.model), plan.target, kRegressFields);
  } catch (const base::InputError& error) {
    add_faults(error, plan.errors, kRegressFields);
  }
  return plan;
}

constexpr std::size_t kNameWidth = 16;

std::string p_text(const std::optional<double>& p) {
  constexpr double kTiny = 1e-4;
  if (!p) return kMissing;
  return *p < kTiny ? fmt::format("{:.1e}", *p) : fmt::format("{:.4f}", *p);
}

std::string figures_cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : kMissing;
}

std::string levels_text(const calibrate::Regression& fit, const std::vector<double>& levels) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    parts.push_back(fmt::format("{} = {:.4g}", fit.factors[i].name, levels[i]));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void add_heading(const calibrate::Regression& fit, Page& page) {
  std::vector<std::string> names, codings;
  for (const calibrate::Factor& factor : fit.factors) {
    names.push_back(factor.name);
    codings.push_back(fmt::format("{} {:g} … {:g}", factor.name, factor.low, factor.high));
  }
  page.add(fmt::format("{} from {}: {} model, {} runs", fit.response_name, fmt::join(names, ", "),
                       name_of(fit.model), fit.runs.size()));
  page.add(fmt::format("coded -1 … 1 are {}", fmt::join(codings, ", ")));
  if (fit.blocks) {
    page.add(fmt::format("blocks by {}: {}", fit.blocks->runs.name,
                         fmt::join(fit.blocks->runs.labels, ", ")));
  }
}

void add_left_out(const std::vector<calibrate::LeftOut>& left_out, Page& page) {
  for (const auto& [what, why] : left_out) page.add(fmt::format("not used: {} ({})", what, why));
}

/// Deviation of each block from the mean of all blocks, which the surface describes.
void add_blocks(const calibrate::Regression& fit, Table& table) {
  for (const calibrate::BlockEffect& effect : fit.blocks->effects) {
    const double half_width = fit.student_t * effect.standard_error;
    table.add_row({fmt::format("{} {}", fit.blocks->runs.name, effect.label),
                   fmt::format("{:.4g}", effect.value),
                   fmt::format("{:.4g}", effect.standard_error), kMissing, kMissing,
                   fit.is_exact ? kMissing
                                : fmt::format("{:.4g} … {:.4g}", effect.value - half_width,
                                              effect.value + half_width)});
  }
}

void add_coefficients(const calibrate::Regression& fit, Page& page) {
  Table table({{.heading = "term", .min_width = kNameWidth},
               number_column("coded"),
               number_column("std. error"),
               number_column("t"),
               number_column("p"),
               number_column("95 % interval")});
  for (const calibrate::Coefficient& coefficient : fit.coefficients) {
    table.add_row(
        {name_of(coefficient.term, fit.factors), fmt::format("{:.4g}", coefficient.value),
         fmt::format("{:.4g}", coefficient.standard_error),
         coefficient.t ? fmt::format("{:.2f}", *coefficient.t) : kMissing, p_text(coefficient.p),
         fit.is_exact
             ? kMissing
             : fmt::format("{:.4g} … {:.4g}", coefficient.interval[0], coefficient.interval[1])});
  }
  if (fit.blocks) add_blocks(fit, table);
  page.add_gap();
  page.add(table);
}

/// The surface in the factors' own units; nothing if these are the coded ones.
void add_equation(const calibrate::Regression& fit, Page& page) {
  const bool is_coded = std::all_of(
      fit.factors.begin(), fit.factors.end(),
      [](const calibrate::Factor& factor) { return factor.low == -1 && factor.high == 1; });
  if (is_coded) return;
  std::string equation = fit.response_name + " =";
  for (const calibrate::Coefficient& coefficient : fit.coefficients) {
    const double value = coefficient.natural;
    const bool is_first = coefficient.term.empty();
    const char* sign = is_first ? (value < 0 ? "-" : "") : (value < 0 ? "- " : "+ ");
    equation += fmt::format(" {}{:.6g}", sign, std::abs(value));
    if (!is_first) equation += ' ' + name_of(coefficient.term, fit.factors);
  }
  page.add(equation);
}

void add_variance(const std::string& name, const calibrate::Variance& variance, Table& table) {
  table.add_row({name, fmt::format("{:.6g}", variance.sum_of_squares),
                 fmt::format("{}", variance.df),
                 variance.df > 0 ? fmt::format("{:.4g}", variance.mean_square()) : kMissing,
                 figures_cell(variance.f), p_text(variance.p)});
}

void add_anova(const calibrate::Regression& fit, Page& page) {
  Table table({{.heading = "source", .min_width = kNameWidth},
               number_column("sum of squares"),
               number_column("df"),
               number_column("mean square"),
               number_column("F"),
               number_column("p")});
  if (fit.blocks) add_variance(fit.blocks->runs.name + " (blocks)", fit.blocks->variance, table);
  add_variance("model", fit.explained, table);
  for (const calibrate::Coefficient& coefficient : fit.coefficients) {
    if (coefficient.term.empty()) continue;
    add_variance("  " + name_of(coefficient.term, fit.factors), coefficient.partial, table);
  }
  add_variance("residual", fit.residual, table);
  if (fit.lack_of_fit) add_variance("  lack of fit", *fit.lack_of_fit, table);
  if (fit.pure_error) add_variance("  pure error", *fit.pure_error, table);
  add_variance("total", fit.total, table);
  for (std::size_t i = 0; i < fit.factors.size(); ++i) {
    add_variance("all of " + fit.factors[i].name, fit.of_factor[i], table);
  }
  table.add_note("", "Sums of squares of terms are partial: what the fit loses without them.");
  page.add_gap();
  page.add(table);
  page.add_gap();
  page.add(fmt::format(
      "R² {:.4f}, adjusted {:.4f}, predicted {}; residual sd {:.4g}", fit.r2, fit.r2_adjusted,
      fit.r2_predicted ? fmt::format("{:.4f}", *fit.r2_predicted) : kMissing, fit.residual_sd));
}

std::string point_text(const calibrate::Regression& fit, const calibrate::SurfacePoint& point) {
  return fmt::format("{:.4g} ± {:.3g} at {}", point.value, point.uncertainty,
                     levels_text(fit, point.natural));
}

/// The end of an interval; std::nullopt: beyond the runs.
std::string end_text(const std::optional<double>& end) {
  return end ? fmt::format("{:.4g}", *end) : "beyond the runs";
}

/// The range of a factor; an end is std::nullopt if the runs end first.
std::string range_text(const std::array<std::optional<double>, 2>& range) {
  const auto& [low, high] = range;
  if (low && high) return fmt::format("{:.4g} … {:.4g}", *low, *high);
  if (low) return fmt::format("from {:.4g} on", *low);
  return high ? fmt::format("up to {:.4g}", *high) : "anywhere";
}

/// Where the surface may be level.
void add_region(const calibrate::Regression& fit, const calibrate::StationaryRegion& region,
                Table& table) {
  if (!region.is_in_box) {
    table.add_row({"stationary", "nowhere in the range of the runs (95 %)"});
    return;
  }
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < fit.factors.size(); ++i) {
    parts.push_back(fmt::format("{} {}", fit.factors[i].name, range_text(region.ranges[i])));
  }
  table.add_row({"stationary", fmt::format("{} (95 %)", fmt::join(parts, ", "))});
}

void add_shape(const calibrate::SurfaceReport& report, Page& page) {
  const calibrate::Regression& fit = report.fit;
  Table table({{}, {}});
  if (report.form) {
    for (const calibrate::CanonicalAxis& axis : report.form->axes) {
      if (fit.factors.size() == 1) continue;  // the square's coefficient is in the table above
      table.add_row({"curvature", fmt::format("{:.4g} ± {:.3g} along {} (coded)", axis.curvature,
                                              axis.uncertainty, levels_text(fit, axis.direction))});
    }
    if (report.form->stationary) {
      table.add_row(
          {name_of(report.form->shape),
           fmt::format("{}, {} the range of the runs", point_text(fit, *report.form->stationary),
                       report.form->is_inside ? "inside" : "outside")});
    }
  }
  if (report.form && report.form->region) add_region(fit, *report.form->region, table);
  table.add_row({"lowest in box", point_text(fit, report.extremes.least)});
  table.add_row({"highest in box", point_text(fit, report.extremes.greatest)});
  page.add_gap();
  page.add(table);
}

std::string range_text(const calibrate::Factor& factor,
                       const std::vector<std::array<double, 2>>& ranges,
                       const std::array<double, 2>& box) {
  std::vector<std::string> parts;
  for (const auto& [low, high] : ranges) {
    parts.push_back(fmt::format("{:.4g} … {:.4g}", factor.natural(low), factor.natural(high)));
  }
  const bool is_all = ranges.size() == 1 && ranges.front() == box;
  return fmt::format("{}{}", fmt::join(parts, " and "), is_all ? ", all of the box" : "");
}

void add_target(const calibrate::SurfaceReport& report, Page& page) {
  if (!report.target || !report.target->is_reached) return;
  const calibrate::Regression& fit = report.fit;
  page.add_gap();
  const calibrate::WantedValue& wanted = report.target->target;
  page.add(fmt::format("{} = {:g}{} within the range of the runs", fit.response_name, wanted.value,
                       wanted.uncertainty > 0 ? fmt::format(" ± {:g}", wanted.uncertainty) : ""));
  const bool is_single = fit.factors.size() == 1;
  Table table({{}, {}});
  for (std::size_t i = 0; i < fit.factors.size() && !is_single; ++i) {
    table.add_row({"  " + fit.factors[i].name,
                   range_text(fit.factors[i], report.target->ranges[i], fit.box[i])});
  }
  page.add(table);
  if (!is_single && !report.target->through_centre.empty()) {
    page.add("with all other factors in the middle of their ranges");
  }
  for (const calibrate::Crossing& crossing : report.target->through_centre) {
    const std::size_t i = crossing.factor;
    const auto& [low, high] = crossing.interval;
    page.add("  ", fmt::format("{} = {:.4g}   95 %: {} … {}", fit.factors[i].name,
                               crossing.point.natural[i], end_text(low), end_text(high)));
  }
}

/// For people: coefficients, analysis of variance, shape, extremes, target, warnings, and unused
/// parts of the table.
std::string regress_table(const RegressPlan& plan, int columns) {
  const calibrate::SurfaceReport& report = plan.report;
  Page page(columns);
  add_heading(report.fit, page);
  add_left_out(plan.left_out, page);
  add_coefficients(report.fit, page);
  add_equation(report.fit, page);
  add_anova(report.fit, page);
  add_shape(report, page);
  add_target(report, page);
  if (!report.diagnostics.empty()) page.add_gap();
  for (const calibrate::SurfaceDiagnostic& diagnostic : report.diagnostics)
    page.add("! ", diagnostic.message);
  for (const std::string& note : plan.notes) page.add("! ", note);
  return page.text();
}

}  // namespace

ExitCode run_regress(const RegressArguments& arguments) {
  const RegressPlan plan = plan_regress(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;

  calibrate::SurfaceSummary summary = summary_of(plan.report);
  summary.left_out = plan.left_out;
  summary.notes = plan.notes;
  Outputs outputs;
  outputs.add(plan.json_file, to_json(summary));
  outputs.show(regress_table(plan, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
