#include "calibrate/statistics/regress/blocks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "calibrate/statistics/regress/quadratic.h"

namespace repose::calibrate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

bool varies_within(const Blocks& blocks, const std::vector<double>& values) {
  std::vector<std::optional<double>> first(blocks.labels.size());
  for (std::size_t run = 0; run < values.size(); ++run) {
    std::optional<double>& known = first[blocks.of_runs[run]];
    if (!known) known = values[run];
    if (*known != values[run]) return true;
  }
  return false;
}

std::size_t block_columns_of(const RunTable& table) {
  return table.blocks && !table.blocks->labels.empty() ? table.blocks->labels.size() - 1 : 0;
}

void check_blocks(const RunTable& table, base::Faults& errors) {
  if (!table.blocks) return;
  const Blocks& blocks = *table.blocks;
  const auto is_known = [&](std::size_t block) { return block < blocks.labels.size(); };
  if (blocks.of_runs.size() != table.responses.size() ||
      !std::all_of(blocks.of_runs.begin(), blocks.of_runs.end(), is_known)) {
    errors.add({.where = table.name,
                .value = fmt::format("{} has {} values for {} runs", blocks.name,
                                     blocks.of_runs.size(), table.responses.size()),
                .fix = "give one for each run."});
    return;
  }
  errors.require(blocks.labels.size() > 1,
                 {.where = table.name,
                  .value = fmt::format("{} is the same in every run", blocks.name),
                  .rule = "two blocks or more",
                  .fix = "leave the blocks out."});
  errors.require(
      varies_within(blocks, table.responses),
      {.where = table.name,
       .value = fmt::format("{} only differs between the blocks of {}, not within any",
                            table.response_name, blocks.name),
       .fix = "there is nothing to explain: name another response or leave the blocks out."});
}

void add_block_columns(const Blocks& blocks, MatrixXd& design) {
  const std::size_t columns = blocks.labels.size() - 1;
  const Index first = design.cols() - index_of(columns);
  for (Index run = 0; run < design.rows(); ++run) {
    const std::size_t block = blocks.of_runs[static_cast<std::size_t>(run)];
    for (std::size_t k = 0; k < columns; ++k) {
      design(run, first + index_of(k)) = block == k ? 1 : block == columns ? -1 : 0;
    }
  }
}

FittedBlocks fitted_blocks(const RunTable& table, const VectorXd& values) {
  FittedBlocks fitted{.runs = *table.blocks, .effects = {}, .variance = {}};
  const std::size_t count = fitted.runs.labels.size();
  std::vector<double> sums(count);
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double value = index_of(k) < values.size() ? values[index_of(k)] : -values.sum();
    fitted.effects.push_back(
        {.label = fitted.runs.labels[k], .runs = 0, .value = value, .standard_error = 0});
  }
  for (std::size_t run = 0; run < table.responses.size(); ++run) {
    const std::size_t block = fitted.runs.of_runs[run];
    sums[block] += table.responses[run];
    sum += table.responses[run];
    ++fitted.effects[block].runs;
  }
  const double mean = sum / static_cast<double>(table.responses.size());
  for (std::size_t k = 0; k < count; ++k) {
    const int runs = fitted.effects[k].runs;
    fitted.variance.sum_of_squares += runs * std::pow(sums[k] / runs - mean, 2);
  }
  fitted.variance.df = static_cast<int>(count) - 1;
  return fitted;
}

void set_errors(FittedBlocks& blocks, const MatrixXd& covariance) {
  for (std::size_t k = 0; k < blocks.effects.size(); ++k) {
    // The last shift is minus the sum of the others.
    const bool is_last = index_of(k) == covariance.cols();
    blocks.effects[k].standard_error =
        std::sqrt(is_last ? covariance.sum() : covariance(index_of(k), index_of(k)));
  }
}

}  // namespace repose::calibrate
