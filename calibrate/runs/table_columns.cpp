#include "calibrate/runs/table_columns.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"
#include "calibrate/statistics/table/other_rows.h"

namespace repose::calibrate {
namespace {

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

}  // namespace

std::string in_small_letters(std::string_view text) {
  std::string small;
  for (const char letter : text) {
    small += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return small;
}

bool is_nothing(const std::string& small) {
  return is_one_of(small, {"", "-", "--", "–", "?", "na", "n/a", "none", "null"});
}

bool says_failed(const std::string& small) {
  return is_one_of(small,
                   {"nan",       "#nan",     "inf",      "-inf",     "+inf",      "#n/a",
                    "#num!",     "#value!",  "#div/0!",  "failed",   "fail",      "failure",
                    "error",     "err",      "crash",    "crashed",  "aborted",   "abort",
                    "killed",    "diverged", "unstable", "exploded", "timeout",   "timed out",
                    "cancelled", "canceled", "lost",     "invalid",  "no reading"});
}

bool says_done(const std::string& small) {
  return is_one_of(small, {"ok", "done", "success", "successful", "succeeded", "finished",
                           "complete", "completed", "converged", "yes", "true", "1", "0"});
}

std::string listed(const std::vector<std::string>& all, std::string_view between) {
  constexpr std::size_t kShown = 10;
  const std::size_t shown = std::min(kShown, all.size());
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(shown);
  const std::string text = fmt::format("{}", fmt::join(all.begin(), end, between));
  return shown == all.size() ? text
                             : fmt::format("{}{}and {} more", text, between, all.size() - shown);
}

namespace {

/// Other columns that programs and people write beside settings and readings.
bool is_bookkeeping(const std::string& column) {
  return is_one_of(
      in_small_letters(column),
      {"run",       "id",       "row",    "order",     "run_order", "std_order", "index",
       "no",        "nr",       "number", "trial",     "point",     "case",      "line",
       "time",      "walltime", "wall_s", "wall_time", "cpu_s",     "cpu_time",  "runtime",
       "runtime_s", "seconds",  "hours",  "date",      "timestamp"});
}

/// Model settings that are not parameters: runs with different values are of another model.
bool is_setting(const std::string& column) {
  return is_one_of(in_small_letters(column),
                   {"stiffness", "stiffness_factor", "young", "young_modulus", "young_modulus_pa",
                    "youngs_modulus", "e_modulus", "timestep", "timestep_s", "time_step", "dt",
                    "spheres", "particles", "n_particles", "grains", "n_grains"});
}

std::optional<std::string> column_of(const Table& table,
                                     std::initializer_list<std::string_view> of) {
  for (const std::string& column : table.columns) {
    if (is_one_of(in_small_letters(column), of)) return column;
  }
  return std::nullopt;
}

bool holds_numbers(const Table& table, std::size_t place) {
  constexpr int kFewest = 8;  // required to learn a reading
  int numbers = 0;
  for (const TableRow& row : table.rows) {
    const std::string small = in_small_letters(row.cells[place]);
    if (number_of(row.cells[place])) {
      ++numbers;
    } else if (!is_nothing(small) && !says_failed(small)) {
      return false;
    }
  }
  return numbers >= kFewest;
}

}  // namespace

namespace {

/// A column's name, and the text in brackets after it; empty unit: there are no brackets.
WantedColumn parted(const std::string& column) {
  for (const auto& [open, close] : {std::pair('[', ']'), {'(', ')'}}) {
    const std::size_t start = column.find(open);
    if (start == 0 || start == std::string::npos || column.back() != close) continue;
    const std::size_t end = column.find_last_not_of(" _", start - 1);
    if (end == std::string::npos) continue;
    return {column.substr(0, end + 1), column.substr(start)};
  }
  return {column};
}

}  // namespace

void take_names_without_units(const std::vector<WantedColumn>& wanted, Table& table,
                              std::vector<std::string>& notes, base::Faults& faults) {
  for (const auto& [name, unit] : wanted) {
    if (table.column(name)) continue;
    const auto is_it = [&](const std::string& column) {
      const WantedColumn both = parted(column);
      return !both.unit.empty() && both.name == name;
    };
    if (std::ranges::count_if(table.columns, is_it) != 1) continue;
    std::string& column = *std::ranges::find_if(table.columns, is_it);
    const std::string theirs = unit_in(parted(column).unit), ours = unit_in(unit);
    if (!theirs.empty() && !ours.empty() && theirs != ours) {
      faults.add(
          {.where = table.name,
           .value = fmt::format("\"{}\" is in another unit than {} in the study, which is in {}",
                                column, name, unit),
           .fix = "convert its numbers, or correct the unit."});
    }
    notes.push_back(fmt::format("{}: \"{}\" is taken for {}.", table.name, column, name));
    column = name;
  }
}

TableColumns columns_of(const TableStudy& study, const Table& table, base::Faults& faults) {
  TableColumns found;
  std::set<std::string> taken;
  const auto need = [&](const std::string& name, const char* section) {
    taken.insert(name);
    if (table.column(name)) return;
    const std::string guess = base::closest_word(name, table.columns);
    faults.add({.where = table.name,
                .value = fmt::format("has no column {}, which is in [{}]{}", name, section,
                                     guess.empty() ? "" : fmt::format(". Did you mean {}?", guess)),
                .fix = fmt::format("its columns are {}.", listed(table.columns))});
  };
  for (const Parameter& parameter : study.parameters) {
    found.parameters.push_back(parameter.name);
    need(parameter.name, "parameter");
  }
  found.readings = readings_of(study);
  found.measured = found.readings.size();
  for (const std::string& reading : found.readings) need(reading, "measured");
  const auto take = [&](std::initializer_list<std::string_view> names) {
    auto column = column_of(table, names);
    if (column && !taken.insert(*column).second) column.reset();
    return column;
  };
  found.count = take({"n", "n_ok", "n_runs", "n_seeds", "repeats", "replicates", "runs", "seeds"});
  found.seed = take({"seed", "random_seed"});
  found.status = take({"status", "state", "outcome"});
  for (std::size_t place = 0; place < table.columns.size(); ++place) {
    const std::string& name = table.columns[place];
    const bool is_sd = std::ranges::any_of(
        std::initializer_list<std::string_view>{"_sd", "_std", "_stdev"}, [&](const auto& ending) {
          if (!name.ends_with(ending)) return false;
          const std::string of = name.substr(0, name.size() - ending.size());
          if (!table.column(of) || taken.contains(name)) return false;
          found.sd[of] = name;
          return true;
        });
    if (is_sd) taken.insert(name);
  }
  // A column n alone may be anything: particles, seeds, row numbers.
  if (found.count && found.sd.empty()) {
    found.unused.push_back(*found.count);
    found.count.reset();
  }
  for (std::size_t place = 0; place < table.columns.size(); ++place) {
    const std::string& name = table.columns[place];
    if (taken.contains(name)) continue;
    if (is_setting(name)) {
      found.settings.push_back(name);
    } else if (!is_bookkeeping(name) && holds_numbers(table, place)) {
      found.readings.push_back(name);
    } else {
      found.unused.push_back(name);
    }
  }
  return found;
}

}  // namespace repose::calibrate
