#include "calibrate/statistics/regress/regression.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/QR>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/distributions.h"
#include "base/input_error.h"
#include "calibrate/statistics/regress/canonical.h"

/// Blocks in the model matrix: b - 1 columns that are 1 in a block, -1 in the last one and 0 in all
/// others. So the shifts add up to 0, and the terms describe the mean of the blocks.

namespace repose::calibrate {

namespace {

using Eigen::Index;

using Eigen::MatrixXd;

using Eigen::VectorXd;

/// Whether values, one for each run, differ between runs of one block.
bool varies_within(const Blocks& blocks, const std::vector<double>& values) {
  std::vector<std::optional<double>> first(blocks.labels.size());
  for (std::size_t run = 0; run < values.size(); ++run) {
    std::optional<double>& known = first[blocks.of_runs[run]];
    if (!known) known = values[run];
    if (*known != values[run]) return true;
  }
  return false;
}

/// For b blocks, b - 1.
std::size_t block_columns_of(const RunTable& table) {
  return table.blocks && !table.blocks->labels.empty() ? table.blocks->labels.size() - 1 : 0;
}

/// Adds every error: needs a block for each run, two blocks or more, responses that vary in them.
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

/// Fills in the last columns of the model matrix.
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

/// The shifts, without their errors, from the coefficients of those columns; and what the blocks'
/// means explain, before the terms: Montgomery, Design and Analysis of Experiments (8th ed.), sec.
/// 4.1. In a design with orthogonal blocks, it is the same after them.
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

/// @param covariance  of the coefficients of the blocks' columns
void set_errors(FittedBlocks& blocks, const MatrixXd& covariance) {
  for (std::size_t k = 0; k < blocks.effects.size(); ++k) {
    // The last shift is minus the sum of the others.
    const bool is_last = index_of(k) == covariance.cols();
    blocks.effects[k].standard_error =
        std::sqrt(is_last ? covariance.sum() : covariance(index_of(k), index_of(k)));
  }
}

}  // namespace

std::vector<Term> terms_of(SurfaceModel model, std::size_t factors) {
  std::vector<Term> terms = {{}};
  for (std::size_t i = 0; i < factors; ++i) terms.push_back({i});
  if (model == SurfaceModel::linear) return terms;
  for (std::size_t i = 0; i < factors; ++i) {
    for (std::size_t j = i + 1; j < factors; ++j) terms.push_back({i, j});
  }
  if (model == SurfaceModel::interaction) return terms;
  for (std::size_t i = 0; i < factors; ++i) terms.push_back({i, i});
  return terms;
}

std::string name_of(const Term& term, const std::vector<Factor>& factors) {
  if (term.empty()) return "1";
  const std::string& first = factors[term.front()].name;
  if (term.size() == 1) return first;
  if (term.front() == term.back()) return first + "^2";
  return fmt::format("{}*{}", first, factors[term.back()].name);
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The box's faces are visited one by one: 3^8 of them.
constexpr std::size_t kMaxRegressed = 8;
/// A column with less than this fraction of its own is linearly dependent on the others.
constexpr double kOwnFraction = 1e-9;

bool is_constant(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [&](double value) { return value == values.front(); });
}

void check_column(const RunTable& table, const std::string& column,
                  const std::vector<double>& values, const char* fix, base::Faults& errors) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  errors.require(values.size() == table.responses.size(),
                 {.where = table.name,
                  .value = fmt::format("{} has {} values for {} runs", column, values.size(),
                                       table.responses.size()),
                  .fix = "give one for each run."});
  if (!std::all_of(values.begin(), values.end(), is_finite)) {
    errors.add({.where = table.name,
                .value = fmt::format("{} has values that are not finite", column),
                .fix = "leave those runs out."});
  } else if (!values.empty() && is_constant(values)) {
    errors.add({.where = table.name,
                .value = fmt::format("{} is {:g} in every run", column, values.front()),
                .fix = fmt::format("{}.", fix)});
  }
}

void check(const RunTable& table, std::size_t terms, base::Faults& errors) {
  const std::size_t factors = table.factors.size();
  errors.require(factors >= 1 && factors <= kMaxRegressed && factors == table.levels.size(),
                 {.where = table.name,
                  .value = fmt::format("{} factors", factors),
                  .rule = fmt::format("1 to {}", kMaxRegressed),
                  .fix = "name the " + base::field("factor columns") + " that matter."});
  for (std::size_t i = 0; i < std::min(factors, table.levels.size()); ++i) {
    const Factor& factor = table.factors[i];
    check_column(table, factor.name, table.levels[i], "leave this factor out", errors);
    errors.require(
        std::isfinite(factor.low) && std::isfinite(factor.high) && factor.low < factor.high,
        {.value =
             fmt::format("{} = {:g}:{:g}: the lower level", factor.name, factor.low, factor.high),
         .rule = "must be below the higher",
         .fix = fmt::format("{}=MIN:MAX.", factor.name)});
  }
  check_column(table, table.response_name, table.responses,
               "there is nothing to explain: name another response", errors);
  check_blocks(table, errors);
  const std::size_t blocks = block_columns_of(table);
  errors.require(table.responses.size() > terms + blocks,
                 {.where = table.name,
                  .value = fmt::format(
                      "{} runs for the {} terms of the model{}", table.responses.size(), terms,
                      blocks == 0 ? "" : fmt::format(" and {} more for blocks", blocks)),
                  .rule = "more runs than terms",
                  .fix = fmt::format("make more runs, or choose the {} or fewer {}.",
                                     base::field("linear model"), base::field("factor columns"))});
}

std::vector<FittedRun> coded_runs(const RunTable& table) {
  std::vector<FittedRun> runs(table.responses.size());
  for (std::size_t run = 0; run < runs.size(); ++run) {
    runs[run].response = table.responses[run];
    for (std::size_t i = 0; i < table.factors.size(); ++i) {
      runs[run].coded.push_back(table.factors[i].coded(table.levels[i][run]));
    }
    if (table.blocks) runs[run].block = table.blocks->labels[table.blocks->of_runs[run]];
  }
  return runs;
}

std::vector<std::array<double, 2>> box_of(const std::vector<FittedRun>& runs) {
  std::vector<std::array<double, 2>> box;
  for (const double level : runs.front().coded) box.push_back({level, level});
  for (const FittedRun& run : runs) {
    for (std::size_t i = 0; i < box.size(); ++i) {
      box[i] = {std::min(box[i][0], run.coded[i]), std::max(box[i][1], run.coded[i])};
    }
  }
  return box;
}

/// X = Q R, columns scaled to length 1 first so that units do not matter.
struct Decomposition {
  VectorXd scale;
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
};

Decomposition decompose(const RunTable& table, const Regression& regression) {
  const Index runs = index_of(regression.runs.size());
  const Index terms = index_of(regression.coefficients.size());
  MatrixXd design(runs, terms + index_of(block_columns_of(table)));
  for (std::size_t i = 0; i < regression.runs.size(); ++i) {
    design.row(index_of(i)).head(terms) =
        term_values(regression.coefficients, regression.runs[i].coded);
  }
  if (table.blocks) add_block_columns(*table.blocks, design);
  Decomposition decomposition;
  decomposition.scale = design.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  decomposition.qr.setThreshold(kOwnFraction);
  decomposition.qr.compute(design * decomposition.scale.asDiagonal());
  return decomposition;
}

void check_rank(const RunTable& table, const Regression& regression,
                const Decomposition& decomposition) {
  const Index rank = decomposition.qr.rank();
  if (rank == decomposition.qr.cols()) return;
  const auto told_by_blocks = std::find_if(
      table.levels.begin(), table.levels.end(), [&](const std::vector<double>& levels) {
        return table.blocks && !varies_within(*table.blocks, levels);
      });
  if (told_by_blocks != table.levels.end()) {
    const auto at = static_cast<std::size_t>(told_by_blocks - table.levels.begin());
    throw base::InputError(
        {.where = table.name,
         .value = fmt::format("{} is the same throughout each block of {}, so that the runs cannot "
                              "tell its effect from theirs",
                              table.factors[at].name, table.blocks->name),
         .fix = fmt::format("{}, if only {} differs between them; otherwise leave {} out of the "
                            "{}, or make runs at several levels in each block.",
                            base::field("choose no blocks"), table.factors[at].name,
                            table.factors[at].name, base::field("factor columns"))});
  }
  std::vector<std::string> names;
  for (Index k = rank; k < decomposition.qr.cols(); ++k) {
    const auto column = static_cast<std::size_t>(decomposition.qr.colsPermutation().indices()[k]);
    const std::size_t terms = regression.coefficients.size();
    if (column >= terms) {
      names.push_back(
          fmt::format("{} {}", table.blocks->name, table.blocks->labels[column - terms]));
      continue;
    }
    const Term& term = regression.coefficients[column].term;
    names.push_back(term.empty() ? "the constant" : name_of(term, regression.factors));
  }
  std::sort(names.begin(), names.end());
  throw base::InputError(
      {.where = table.name,
       .value = fmt::format("the runs cannot tell {} from other terms{}", fmt::join(names, ", "),
                            table.blocks ? " or blocks" : ""),
       .rule = "a square needs three levels of its factor, and no term may follow from others",
       .fix = fmt::format("choose the {} or fewer {}, or a design made for the model.",
                          base::field("linear model"), base::field("factor columns"))});
}

/// F of a variance against that of an error; left empty if the error is only rounding.
void test_against(Variance& variance, const Variance& error, bool is_testable) {
  if (!is_testable || variance.df < 1) return;
  variance.f = variance.mean_square() / error.mean_square();
  variance.p = base::fisher_f_above(*variance.f, variance.df, error.df);
}

/// Residual = lack of fit + pure error. Montgomery, sec. 11.2: runs with equal levels, of one block
/// if there are blocks, can differ only by error.
void split_residual(const RunTable& table, Regression& regression) {
  std::map<std::vector<double>, std::vector<double>> groups;
  for (std::size_t run = 0; run < table.responses.size(); ++run) {
    std::vector<double> levels;
    for (const std::vector<double>& column : table.levels) levels.push_back(column[run]);
    if (table.blocks) levels.push_back(static_cast<double>(table.blocks->of_runs[run]));
    groups[levels].push_back(table.responses[run]);
  }
  Variance pure;
  double largest = 0;
  for (const auto& [levels, responses] : groups) {
    double mean = 0;
    for (const double response : responses)
      mean += response / static_cast<double>(responses.size());
    for (const double response : responses) {
      pure.sum_of_squares += (response - mean) * (response - mean);
      largest = std::max(largest, std::abs(response));
    }
    pure.df += static_cast<int>(responses.size()) - 1;
  }
  if (pure.df == 0) return;
  regression.pure_error = pure;
  Variance lack{
      .sum_of_squares = std::max(0.0, regression.residual.sum_of_squares - pure.sum_of_squares),
      .df = regression.residual.df - pure.df,
      .f = {},
      .p = {}};
  if (lack.df < 1) return;
  constexpr double kRounding = 1e-13;
  test_against(lack, pure, pure.sum_of_squares > std::pow(kRounding * largest, 2));
  regression.lack_of_fit = lack;
}

void set_residuals(Regression& regression, const Decomposition& decomposition) {
  // Number of terms and blocks.
  const Index runs = decomposition.qr.rows(), terms = decomposition.qr.cols();
  const MatrixXd q = decomposition.qr.householderQ() * MatrixXd::Identity(runs, terms);
  double mean = 0, largest = 0;
  for (const FittedRun& run : regression.runs) mean += run.response / static_cast<double>(runs);
  double press = 0;
  bool has_press = true;
  constexpr double kAlone = 1 - 1e-9;
  for (std::size_t i = 0; i < regression.runs.size(); ++i) {
    FittedRun& run = regression.runs[i];
    run.fitted = regression.predicted(run.coded);
    if (const auto& blocks = regression.blocks) {
      run.fitted += blocks->effects[blocks->runs.of_runs[i]].value;
    }
    run.leverage = q.row(index_of(i)).squaredNorm();
    const double residual = run.response - run.fitted;
    regression.residual.sum_of_squares += residual * residual;
    regression.total.sum_of_squares += (run.response - mean) * (run.response - mean);
    has_press = has_press && run.leverage < kAlone;
    press += std::pow(residual / (1 - run.leverage), 2);
    largest = std::max(largest, std::abs(run.response));
  }
  regression.residual.df = static_cast<int>(runs - terms);
  regression.total.df = static_cast<int>(runs) - 1;
  const Variance between = regression.blocks ? regression.blocks->variance : Variance{};
  const Variance within{.sum_of_squares = regression.total.sum_of_squares - between.sum_of_squares,
                        .df = regression.total.df - between.df,
                        .f = {},
                        .p = {}};
  regression.explained.df = static_cast<int>(regression.coefficients.size()) - 1;
  regression.explained.sum_of_squares = within.sum_of_squares - regression.residual.sum_of_squares;
  constexpr double kRounding = 1e-13;
  regression.is_exact = regression.residual.sum_of_squares <=
                        std::pow(kRounding * largest, 2) * static_cast<double>(runs);
  regression.residual_sd = std::sqrt(regression.residual.mean_square());
  regression.r2 = 1 - regression.residual.sum_of_squares / within.sum_of_squares;
  regression.r2_adjusted = 1 - regression.residual.mean_square() / within.mean_square();
  if (!has_press) return;
  regression.press = press;
  regression.r2_predicted = 1 - press / within.sum_of_squares;
}

/// What the fit loses without some terms: b'C^-1 b, C their block of (X'X)^-1.
Variance loss_without(const Regression& regression, const std::vector<Index>& terms,
                      const MatrixXd& inverse_normal) {
  VectorXd values(index_of(terms.size()));
  for (std::size_t k = 0; k < terms.size(); ++k) {
    values[index_of(k)] = regression.coefficients[static_cast<std::size_t>(terms[k])].value;
  }
  const MatrixXd block = inverse_normal(terms, terms);
  Variance loss{.sum_of_squares = values.dot(block.ldlt().solve(values)),
                .df = static_cast<int>(terms.size()),
                .f = {},
                .p = {}};
  test_against(loss, regression.residual, !regression.is_exact);
  return loss;
}

void set_tests(Regression& regression, const Decomposition& decomposition) {
  const Index columns = decomposition.qr.cols();
  const Index terms = index_of(regression.coefficients.size());
  const MatrixXd r = decomposition.qr.matrixR().topRows(columns);
  const MatrixXd inverse_r =
      r.triangularView<Eigen::Upper>().solve(MatrixXd::Identity(columns, columns));
  const MatrixXd unscaled =
      decomposition.scale.asDiagonal() * (decomposition.qr.colsPermutation() * inverse_r);
  const MatrixXd inverse_normal = unscaled * unscaled.transpose();
  const double variance = regression.residual.mean_square();
  const int df = regression.residual.df;
  regression.student_t = base::student_t_quantile(.975, df);
  std::vector<std::vector<Index>> of_factor(regression.factors.size());
  for (Index k = 0; k < terms; ++k) {
    Coefficient& coefficient = regression.coefficients[static_cast<std::size_t>(k)];
    coefficient.standard_error = std::sqrt(variance * inverse_normal(k, k));
    const double half_width = regression.student_t * coefficient.standard_error;
    coefficient.interval = {coefficient.value - half_width, coefficient.value + half_width};
    coefficient.partial = loss_without(regression, {k}, inverse_normal);
    if (!regression.is_exact) {
      coefficient.t = coefficient.value / coefficient.standard_error;
      coefficient.p = 2 * base::student_t_above(std::abs(*coefficient.t), df);
    }
    for (std::size_t i = 0; i < of_factor.size(); ++i) {
      const Term& term = coefficient.term;
      if (std::find(term.begin(), term.end(), i) != term.end()) of_factor[i].push_back(k);
    }
  }
  for (const std::vector<Index>& which : of_factor) {
    regression.of_factor.push_back(loss_without(regression, which, inverse_normal));
  }
  if (regression.blocks) {
    const Index blocks = columns - terms;
    set_errors(*regression.blocks, variance * inverse_normal.bottomRightCorner(blocks, blocks));
  }
  const MatrixXd covariance = variance * inverse_normal.topLeftCorner(terms, terms);
  regression.covariance.assign(covariance.data(), covariance.data() + covariance.size());
  test_against(regression.explained, regression.residual, !regression.is_exact);
}

}  // namespace

double Regression::predicted(std::span<const double> coded) const {
  const VectorXd values = term_values(coefficients, coded);
  double sum = 0;
  for (std::size_t k = 0; k < coefficients.size(); ++k)
    sum += coefficients[k].value * values[index_of(k)];
  return sum;
}

double Regression::standard_error(std::span<const double> coded) const {
  const VectorXd values = term_values(coefficients, coded);
  const Eigen::Map<const MatrixXd> matrix(covariance.data(), values.size(), values.size());
  return std::sqrt(std::max(0.0, values.dot(matrix * values)));
}

Regression regress(const RunTable& table, SurfaceModel model) {
  const std::vector<Term> terms = terms_of(model, table.factors.size());
  base::Faults errors;
  check(table, terms.size(), errors);
  errors.throw_if_any();

  Regression regression;
  regression.model = model;
  regression.response_name = table.response_name;
  regression.factors = table.factors;
  regression.runs = coded_runs(table);
  regression.box = box_of(regression.runs);
  for (const Term& term : terms) regression.coefficients.emplace_back().term = term;
  const Decomposition decomposition = decompose(table, regression);
  check_rank(table, regression, decomposition);

  const Eigen::Map<const VectorXd> responses(table.responses.data(),
                                             index_of(table.responses.size()));
  const VectorXd values = decomposition.scale.cwiseProduct(decomposition.qr.solve(responses));
  for (std::size_t k = 0; k < terms.size(); ++k)
    regression.coefficients[k].value = values[index_of(k)];
  if (table.blocks) {
    regression.blocks = fitted_blocks(table, values.tail(index_of(block_columns_of(table))));
  }
  set_natural(regression);
  set_residuals(regression, decomposition);
  set_tests(regression, decomposition);
  split_residual(table, regression);
  return regression;
}

}  // namespace repose::calibrate
