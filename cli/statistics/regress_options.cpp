#include "cli/statistics/regress_options.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "calibrate/statistics/regress/run_table.h"
#include "cli/common/number.h"
#include "cli/common/output.h"
#include "cli/common/output_places.h"
#include "cli/statistics/factor_options.h"

namespace repose::cli {
namespace {

void read_model(const std::string& text, RegressPlan& plan) {
  using calibrate::SurfaceModel;
  if (text.empty() || text == "quadratic") return;
  if (text == "linear") {
    plan.model = SurfaceModel::linear;
  } else if (text == "interaction") {
    plan.model = SurfaceModel::interaction;
  } else {
    plan.errors.push_back(fmt::format(
        "--model {}: is none that is known here. Fix: linear, interaction or quadratic.", text));
  }
}

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

}  // namespace

RegressPlan plan_regress(const RegressArguments& arguments) {
  RegressPlan plan;
  plan.json_file = arguments.json_file;
  read_model(arguments.model, plan);
  const std::vector<std::string> factors = names_in(arguments.factors, plan);
  std::vector<calibrate::Factor> codings;
  for (const std::string& text : arguments.codings) {
    if (const auto coding = factor_in("--coding", text, plan.errors)) codings.push_back(*coding);
  }
  if (!arguments.target.empty()) {
    plan.target = number_in<double>(arguments.target);
    if (!plan.target) {
      plan.errors.push_back(
          fmt::format("--target {}: must be a number. Fix: --target 23.4.", arguments.target));
    }
  }
  check_output_places({{"--json", plan.json_file}}, {arguments.table}, plan.errors);
  try {
    const calibrate::RunTable runs = calibrate::runs_in(calibrate::read_table(arguments.table),
                                                        arguments.response, factors, codings);
    plan.report = report_on(calibrate::regress(runs, plan.model), plan.target);
  } catch (const std::invalid_argument& error) {
    add_lines(error.what(), plan.errors);
  }
  return plan;
}

}  // namespace repose::cli
