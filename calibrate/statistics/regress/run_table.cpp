#include "calibrate/statistics/regress/run_table.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error_list.h"

namespace repose::calibrate {
namespace {

bool is_bookkeeping(std::string_view column) {
  constexpr std::array<std::string_view, 3> kNames = {"run", "standard", "point"};
  return std::find(kNames.begin(), kNames.end(), column) != kNames.end() ||
         column.ends_with("_coded");
}

std::vector<std::string> all_factors(const Table& table, const std::string& response) {
  std::vector<std::string> factors;
  for (const std::string& column : table.columns) {
    if (column != response && !is_bookkeeping(column)) factors.push_back(column);
  }
  return factors;
}

/// Which runs are corners of a central composite design: they are at -1 and +1.
std::vector<bool> cube_runs(const Table& table) {
  const auto point = table.column("point");
  std::vector<bool> is_cube;
  for (const TableRow& row : table.rows) is_cube.push_back(point && row.cells[*point] == "cube");
  if (std::find(is_cube.begin(), is_cube.end(), true) == is_cube.end()) {
    is_cube.assign(is_cube.size(), true);
  }
  return is_cube;
}

Factor coding_of(const std::string& name, const std::vector<double>& levels,
                 const std::vector<bool>& is_cube, const std::vector<Factor>& codings) {
  const auto given = std::find_if(codings.begin(), codings.end(),
                                  [&](const Factor& factor) { return factor.name == name; });
  if (given != codings.end()) return *given;
  const auto has = [&](double level) {
    return std::find(levels.begin(), levels.end(), level) != levels.end();
  };
  const auto [lowest, highest] = std::minmax_element(levels.begin(), levels.end());
  if (*lowest == -*highest && has(-1) && has(1)) return {name, -1, 1};
  Factor factor{name, *highest, *lowest};
  for (std::size_t run = 0; run < levels.size(); ++run) {
    if (!is_cube[run]) continue;
    factor.low = std::min(factor.low, levels[run]);
    factor.high = std::max(factor.high, levels[run]);
  }
  return factor;
}

void check_names(const Table& table, const std::string& response,
                 const std::vector<std::string>& factors, const std::vector<Factor>& codings,
                 base::ErrorList& errors) {
  for (std::size_t i = 0; i < factors.size(); ++i) {
    errors.require(factors[i] != response,
                   fmt::format("{}: {} is the response, and no factor. Fix: leave it out of the "
                               "factor columns.",
                               table.name, response));
    errors.require(
        std::find(factors.begin(), factors.begin() + static_cast<std::ptrdiff_t>(i), factors[i]) ==
            factors.begin() + static_cast<std::ptrdiff_t>(i),
        fmt::format("{}: factor {} is named twice. Fix: name it once.", table.name, factors[i]));
  }
  for (const Factor& coding : codings) {
    errors.require(
        std::find(factors.begin(), factors.end(), coding.name) != factors.end(),
        fmt::format("{}: {} has a coding, but is none of the factors ({}). Fix: name one "
                    "of them.",
                    table.name, coding.name, fmt::join(factors, ", ")));
  }
}

}  // namespace

RunTable runs_in(const Table& table, const std::string& response,
                 const std::vector<std::string>& factors, const std::vector<Factor>& codings) {
  const std::vector<std::string> names = factors.empty() ? all_factors(table, response) : factors;
  base::ErrorList errors;
  check_names(table, response, names, codings, errors);
  std::vector<std::string> columns = names;
  columns.push_back(response);
  RunTable runs;
  runs.name = table.name;
  runs.response_name = response;
  try {
    runs.levels = numbers_of(table, columns);
  } catch (const std::invalid_argument& error) {
    errors.add(error.what());
  }
  errors.throw_if_any();
  runs.responses = std::move(runs.levels.back());
  runs.levels.pop_back();
  const std::vector<bool> is_cube = cube_runs(table);
  for (std::size_t i = 0; i < names.size(); ++i) {
    runs.factors.push_back(coding_of(names[i], runs.levels[i], is_cube, codings));
  }
  return runs;
}

}  // namespace repose::calibrate
