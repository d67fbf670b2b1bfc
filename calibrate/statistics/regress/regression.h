#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/statistics/factor.h"

/// Response surfaces: a polynomial of the factors, fitted to the runs of a design by least squares.
/// Factors are coded (Factor): -1 and +1 are their low and high. THEORY.md has the formulas.

namespace repose::calibrate {

enum class SurfaceModel {
  linear,       ///< 1, x_i
  interaction,  ///< and x_i x_j
  quadratic,    ///< and x_i^2
};

/// Which runs were made together, on one day or from one batch: a whole block may be shifted
/// relative to another.
struct Blocks {
  std::string name;                  ///< of the column: "Day"
  std::vector<std::string> labels;   ///< of each block: "Mon", in the order of their first runs
  std::vector<std::size_t> of_runs;  ///< the block of each run
};

/// Results of runs.
struct RunTable {
  std::string name;                         ///< for messages
  std::vector<Factor> factors;              ///< define the coding of levels
  std::vector<std::vector<double>> levels;  ///< natural: [factor][run]
  std::string response_name;
  std::vector<double> responses;
  std::optional<Blocks> blocks = {};
};

/// A product of up to two factors: {} is 1, {0} the first factor, {1, 1} the second's square.
using Term = std::vector<std::size_t>;

std::vector<Term> terms_of(SurfaceModel model, std::size_t factors);

/// "1", "e", "e*mu", "e^2".
std::string name_of(const Term& term, const std::vector<Factor>& factors);

/// How much of the scatter something explains, and whether chance would do as well. F and p are
/// absent if there is nothing to compare with.
struct Variance {
  double sum_of_squares = 0;
  int df = 0;
  std::optional<double> f;
  std::optional<double> p;

  double mean_square() const { return sum_of_squares / df; }
};

struct Coefficient {
  Term term;
  double value = 0;                  ///< of the coded factors
  double natural = 0;                ///< of the factors in their own units
  double standard_error = 0;         ///< of the coded one
  std::array<double, 2> interval{};  ///< 95 %, of the coded one
  std::optional<double> t, p;
  Variance partial;  ///< what the fit loses without this term
};

struct FittedRun {
  std::vector<double> coded;
  double response = 0;
  double fitted = 0;  ///< including the shift of its block
  double leverage = 0;
  std::string block = {};  ///< its label, if runs are in blocks
};

/// Shift of a block relative to the mean of all blocks.
struct BlockEffect {
  std::string label;
  int runs = 0;
  double value = 0;
  double standard_error = 0;
};

/// Effects of the blocks. They have no F: blocks are not assigned to runs at random.
struct FittedBlocks {
  Blocks runs;
  std::vector<BlockEffect> effects;  ///< they add up to 0
  Variance variance;                 ///< of the blocks' means, before the terms
};

struct Regression {
  SurfaceModel model = SurfaceModel::quadratic;
  std::string response_name;
  std::vector<Factor> factors;
  std::vector<Coefficient> coefficients;
  std::vector<double> covariance;  ///< of the coded coefficients, row by row
  std::vector<FittedRun> runs;
  std::vector<std::array<double, 2>> box;  ///< range of coded levels of the runs, for each factor

  Variance explained;  ///< by all terms but the constant, beyond what the blocks explain
  Variance residual;
  Variance total;
  std::optional<Variance> pure_error;   ///< scatter of runs with the same levels
  std::optional<Variance> lack_of_fit;  ///< the rest of the residual, tested against the pure error
  std::vector<Variance> of_factor;      ///< what the fit loses without any term of a factor
  std::optional<FittedBlocks> blocks;

  double residual_sd = 0;
  bool is_exact = false;  ///< only rounding errors are left: no test is possible
  double r2 = 0;          ///< of the scatter within blocks, like the two that follow
  double r2_adjusted = 0;
  /// Prediction sum of squares: each run predicted from the others. std::nullopt if a run alone
  /// determines some term (leverage 1).
  std::optional<double> press;
  std::optional<double> r2_predicted;
  double student_t = 0;  ///< 97.5 % point for the residual's degrees of freedom

  /// At the mean of the blocks, which all have equal weight.
  double predicted(std::span<const double> coded) const;
  /// Standard error of the surface there, not of a new run.
  double standard_error(std::span<const double> coded) const;
};

/// Least squares by QR decomposition. Montgomery, Design and Analysis of Experiments (8th ed.), ch.
/// 10 and 11; blocks ch. 4 and 11.4.3. Proved by Regression.* and RegressionBlocks.* in
/// tests/calibrate/regress_test.cpp: the hazelnut study's printed analysis, R's lm, and NIST's
/// Longley problem.
///
/// @throws base::InputError  every error: no factors or more than 8, a constant factor or response,
/// not more runs than terms and blocks, values that are not finite, terms confounded with others or
/// with blocks.
Regression regress(const RunTable& table, SurfaceModel model);

}  // namespace repose::calibrate
