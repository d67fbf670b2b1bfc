#include "calibrate/statistics/regress/run_table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "calibrate/statistics/table/other_rows.h"

namespace repose::calibrate {
namespace {

using Names = std::vector<std::string>;

bool contains(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Lower-case letters and digits only: "Std Order" is stdorder.
std::string plain_name(std::string_view column) {
  std::string name;
  for (const char letter : column) {
    const auto byte = static_cast<unsigned char>(letter);
    if (std::isalnum(byte) != 0) name += static_cast<char>(std::tolower(byte));
  }
  return name;
}

bool is_one_of(const std::string& name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Contents of a column of a table.
class Column {
 public:
  Column(const Table& table, std::size_t place) {
    for (const TableRow& row : table.rows) {
      const std::string& cell = row.cells[place];
      ++counts_[cell];
      const auto number = number_of(cell);
      has_text_ = has_text_ || (!number && !cell.empty());
      if (number) numbers_.push_back(*number);
    }
    rows_ = table.rows.size();
  }

  bool is_empty() const { return numbers_.empty() && !has_text_; }
  bool is_text() const { return numbers_.empty() && has_text_; }
  std::size_t different() const { return counts_.size(); }
  /// At least two values, each in at least two rows.
  bool may_be_blocks() const {
    return counts_.size() > 1 && std::all_of(counts_.begin(), counts_.end(),
                                             [](const auto& one) { return one.second > 1; });
  }
  /// Whole numbers, all different.
  bool may_be_order() const {
    std::set<double> seen;
    return numbers_.size() == rows_ &&
           std::all_of(numbers_.begin(), numbers_.end(), [&](double number) {
             return number >= 0 && number == std::floor(number) && seen.insert(number).second;
           });
  }
  /// Each number from 0 or 1 on, once.
  bool is_count() const {
    constexpr std::size_t kFewest = 4;
    if (rows_ < kFewest || !may_be_order()) return false;
    const auto [least, greatest] = std::minmax_element(numbers_.begin(), numbers_.end());
    return *least <= 1 && *greatest - *least == static_cast<double>(rows_ - 1);
  }

 private:
  std::map<std::string, int> counts_;
  std::vector<double> numbers_;
  bool has_text_ = false;
  std::size_t rows_ = 0;
};

/// What designs, design programs and people write beside the levels, recognised by its name; empty:
/// something else.
std::string bookkeeping_of(const std::string& name, const Column& column) {
  const std::string plain = plain_name(name);
  if (is_one_of(plain, {"run", "standard"}) ||
      (column.may_be_order() &&
       is_one_of(plain, {"std", "stdorder", "standardorder", "order", "runorder", "runno",
                         "runnumber", "trial", "id", "row", "rowname", "rownames"}))) {
    return "the order of the runs";
  }
  if (is_one_of(plain, {"point", "pointtype", "pttype", "spacetype", "buildtype", "pattern"})) {
    return "the kind of point";
  }
  if (name.ends_with("_coded")) return "coded levels of another column";
  const bool is_remark = is_one_of(plain, {"comment", "comments", "note", "notes", "remark",
                                           "remarks", "date", "time", "timestamp"});
  if (is_remark && column.is_text()) return "a remark";
  return {};
}

/// Usual names for what runs made together have in common; their numbers are not levels.
bool is_name_of_blocks(const std::string& name) {
  return is_one_of(plain_name(name),
                   {"block", "blocks", "session", "shift", "batch", "lot", "series", "operator",
                    "person", "site", "lab", "machine", "rig", "replicate", "replication", "rep"});
}

/// Runs of one day may form a block, and an age in days may be a factor.
bool sounds_like_blocks(const std::string& name) {
  return is_one_of(plain_name(name), {"day", "week", "month"});
}

/// Determines the role of each column.
class ColumnSorter {
 public:
  ColumnSorter(const Table& table, const RunColumns& wanted, base::Faults& errors)
      : table_(table), wanted_(wanted), factors_(wanted.factors), blocks_(wanted.blocks) {
    if (blocks_ == kNoBlocks) blocks_.clear();
    for (std::size_t place = 0; place < table.columns.size(); ++place) look_at(place);
    if (candidates_.size() > 1) {
      errors.add({.where = table.name,
                  .value = fmt::format("{} may all be blocks", fmt::join(candidates_, ", ")),
                  .fix = "name one of them as " + base::field("blocks column") + ", or none."});
    } else if (!candidates_.empty()) {
      blocks_ = candidates_.front();
    }
    settle_counts(errors);
  }

  const Names& factors() const { return factors_; }
  const std::string& blocks() const { return blocks_; }
  std::vector<LeftOut> take_left_out() { return std::move(left_out_); }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void look_at(std::size_t place) {
    const std::string& name = table_.columns[place];
    if (name == wanted_.response || name == blocks_ || contains(wanted_.factors, name)) return;
    const Column column(table_, place);
    const std::string bookkeeping = bookkeeping_of(name, column);
    const bool seeks_blocks = wanted_.blocks.empty();
    const bool is_called_block = is_name_of_blocks(name);
    if (!bookkeeping.empty()) {
      leave_out(name, bookkeeping);
    } else if (column.is_empty()) {
      leave_out(name, "empty");
    } else if (seeks_blocks && (column.is_text() || is_called_block) && column.may_be_blocks()) {
      candidates_.push_back(name);
      if (!column.is_text()) {
        notes_.push_back(fmt::format(
            "The numbers of {} are taken for names of blocks, runs that were made together. If "
            "they are levels of a factor, name the {}.",
            name, base::with_names(base::field("factor columns"), wanted_.names)));
      }
    } else if (column.is_text() || is_called_block) {
      leave_out(name, column.different() == 1 ? "the same in every run"
                      : seeks_blocks          ? "it does not part the runs into blocks"
                      : blocks_.empty()       ? "no blocks are wanted, and its name is no factor's"
                                              : "the blocks are those of " + blocks_);
    } else if (!wanted_.factors.empty()) {
      return;  // left out by naming the factors
    } else if (column.is_count()) {
      counts_.push_back(name);
    } else {
      factors_.push_back(name);
      if (seeks_blocks && column.may_be_blocks() && sounds_like_blocks(name)) {
        notes_.push_back(
            fmt::format("{} holds numbers and is taken for a factor. If it only says which runs "
                        "were made together, name it as {}.",
                        name, base::with_names(base::field("blocks column"), wanted_.names)));
      }
    }
  }

  void settle_counts(base::Faults& errors) {
    if (counts_.empty()) return;
    if (!factors_.empty()) {
      for (const std::string& name : counts_) {
        leave_out(name,
                  "each number once, as in the order of runs; if it is a factor, name the "
                  "factor columns");
      }
      return;
    }
    factors_ = counts_;
    if (counts_.size() == 1) return;
    errors.add({.where = table_.name,
                .value = fmt::format("{} hold each number once, as the order of runs does",
                                     fmt::join(counts_, ", ")),
                .fix = "name the " + base::field("factor columns") + '.'});
  }

  void leave_out(const std::string& name, std::string why) {
    if (!wanted_.factors.empty()) return;
    left_out_.push_back({"column " + name, std::move(why)});
  }

  const Table& table_;
  const RunColumns& wanted_;
  Names factors_;
  std::string blocks_;
  Names candidates_;  ///< for blocks
  Names counts_;
  std::vector<LeftOut> left_out_;
  std::vector<std::string> notes_;
};

Blocks blocks_in(const Table& table, const std::string& name) {
  const auto place = table.column(name);
  if (!place) {
    throw base::InputError({.where = table.name,
                            .value = fmt::format("has no column {} for blocks", name),
                            .fix = fmt::format("it has {}.", fmt::join(table.columns, ", "))});
  }
  Blocks blocks{.name = name, .labels = {}, .of_runs = {}};
  for (const TableRow& row : table.rows) {
    const std::string& label = row.cells[*place];
    if (label.empty()) {
      throw base::InputError({.where = fmt::format("{}:{}", table.name, row.line),
                              .value = fmt::format("{} is empty", name),
                              .fix = "write the run's block, or delete the row."});
    }
    const auto known = std::find(blocks.labels.begin(), blocks.labels.end(), label);
    blocks.of_runs.push_back(static_cast<std::size_t>(known - blocks.labels.begin()));
    if (known == blocks.labels.end()) blocks.labels.push_back(label);
  }
  return blocks;
}

/// Which runs are corners of a central composite design, at -1 and +1.
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
                 base::Faults& errors) {
  for (std::size_t i = 0; i < factors.size(); ++i) {
    errors.require(factors[i] != response,
                   {.where = table.name,
                    .value = fmt::format("{} is the response, and no factor", response),
                    .fix = "leave it out of the " + base::field("factor columns") + '.'});
    errors.require(std::find(factors.begin(), factors.begin() + static_cast<std::ptrdiff_t>(i),
                             factors[i]) == factors.begin() + static_cast<std::ptrdiff_t>(i),
                   {.where = table.name,
                    .value = fmt::format("factor {} is named twice", factors[i]),
                    .fix = "name it once."});
  }
  for (const Factor& coding : codings) {
    errors.require(std::find(factors.begin(), factors.end(), coding.name) != factors.end(),
                   {.where = table.name,
                    .value = fmt::format("{} has a coding, but is none of the factors ({})",
                                         coding.name, fmt::join(factors, ", ")),
                    .fix = "name one of them."});
  }
}

}  // namespace

TableOfRuns runs_in(Table table, const RunColumns& columns) {
  base::Faults errors;
  const Names response = {columns.response};
  OtherRows other = take_other_rows(table, response, Unlabelled::noted, errors);
  ColumnSorter sorted(table, columns, errors);
  const Names& names = sorted.factors();
  check_names(table, columns.response, names, columns.codings, errors);
  TableOfRuns result{
      .runs = {}, .left_out = std::move(other.left_out), .notes = std::move(other.notes)};
  RunTable& runs = result.runs;
  runs.name = table.name;
  runs.response_name = columns.response;
  std::vector<NumberColumn> numbers;
  for (const std::string& name : names) numbers.push_back({.name = name});
  numbers.push_back({.name = columns.response});
  try {
    if (!sorted.blocks().empty()) runs.blocks = blocks_in(table, sorted.blocks());
  } catch (const base::InputError& error) {
    errors.add_all(error.faults());
  }
  try {
    runs.levels = numbers_of(table, numbers);
  } catch (const base::InputError& error) {
    errors.add_all(error.faults());
  }
  errors.throw_if_any();
  for (LeftOut& one : sorted.take_left_out()) result.left_out.push_back(std::move(one));
  result.notes.insert(result.notes.end(), sorted.notes().begin(), sorted.notes().end());
  runs.responses = std::move(runs.levels.back());
  runs.levels.pop_back();
  const std::vector<bool> is_cube = cube_runs(table);
  for (std::size_t i = 0; i < names.size(); ++i) {
    runs.factors.push_back(coding_of(names[i], runs.levels[i], is_cube, columns.codings));
  }
  return result;
}

}  // namespace repose::calibrate
