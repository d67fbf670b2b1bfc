#include "cli/statistics/regress_options.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/statistics/regress/run_table.h"
#include "cli/common/number.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/output_places.h"
#include "cli/statistics/factor_options.h"

namespace repose::cli {
namespace {

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
  const auto wanted = number_in<double>(value);
  const auto spread =
      uncertainty.empty() && value == text ? 0.0 : number_in<double>(uncertainty).value_or(-1);
  if (wanted && spread >= 0) return calibrate::WantedValue{*wanted, spread};
  if (text.empty()) return std::nullopt;
  Typed{"--target", text, errors}.refuse(
      "a number, or one with the half-width of its 95 % interval behind ±",
      "--target 23.4 or --target 23.38±0.23");
  return std::nullopt;
}

}  // namespace

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

}  // namespace repose::cli
