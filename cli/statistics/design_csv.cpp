#include "cli/statistics/design_csv.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "base/csv.h"

namespace repose::cli {
namespace {

/// Short, without the rounding of the last bits: 0.3, not 0.30000000000000004.
std::string level_text(double level) {
  const std::string text = fmt::format("{:.12g}", level);
  return text == "-0" ? "0" : text;
}

/// What is nothing but rounding beside the factor's range is 0.
double without_rounding(double natural, const calibrate::Factor& factor) {
  constexpr double kRounding = 1e-14;
  const double size = std::abs(factor.low) + std::abs(factor.high);
  return std::abs(natural) < kRounding * size ? 0 : natural;
}

}  // namespace

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

}  // namespace repose::cli
