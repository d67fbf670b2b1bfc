#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/statistics/left_out.h"
#include "calibrate/statistics/regress/surface_report.h"

namespace repose::calibrate {

/// A factor of a fitted surface: the levels of its runs, and the variance explained by all of its
/// terms.
struct SurfaceFactor : Factor {
  std::array<double, 2> box{};  ///< lowest and highest level, natural
  Variance all_terms;
};

struct SurfaceTerm {
  std::string term;                  ///< "1", "e", "e*mu", "e^2"
  double value = 0;                  ///< for coded factors
  double standard_error = 0;         ///< of that
  std::optional<double> t, p;        ///< of that
  std::array<double, 2> interval{};  ///< 95 %, of that
  double partial_sum_of_squares = 0;
  double natural = 0;  ///< for factors in their own units
};

/// Blocks of runs, as in FittedBlocks.
struct SurfaceBlocks {
  std::string column;
  std::vector<BlockEffect> effects;
};

struct SurfaceVariances {
  std::optional<Variance> blocks = {};
  Variance model;  ///< all terms but the constant
  Variance residual;
  std::optional<Variance> lack_of_fit;
  std::optional<Variance> pure_error;
  Variance total;
};

/// A point at which the surface has the target value.
struct SurfaceCrossing {
  std::size_t factor = 0;      ///< along whose axis it was found
  std::vector<double> levels;  ///< natural
  /// Of the level along that axis, 95 %, natural; an end is std::nullopt if the runs' range ends
  /// first.
  std::array<std::optional<double>, 2> interval;
};

struct SurfaceTarget {
  double value = 0;
  double uncertainty = 0;  ///< half-width of its 95 % interval; 0: exact
  bool is_reached = false;
  std::vector<std::vector<std::array<double, 2>>> ranges;  ///< natural intervals of each factor
  std::vector<SurfaceCrossing> through_centre;
  std::vector<SurfaceCrossing> points;
};

/// A fitted surface as stored in files. Vectors of levels are in the order of `factors`.
struct SurfaceSummary {
  std::string response;
  SurfaceModel model = SurfaceModel::quadratic;
  std::vector<SurfaceFactor> factors;
  std::vector<SurfaceTerm> coefficients;
  std::optional<SurfaceBlocks> blocks = {};
  SurfaceVariances anova;
  double residual_sd = 0;
  double r2 = 0;
  double r2_adjusted = 0;
  std::optional<double> r2_predicted;
  std::optional<double> press;
  std::optional<CanonicalForm> canonical;
  BoxExtremes extremes;
  std::optional<SurfaceTarget> target;
  std::vector<FittedRun> runs;  ///< empty in a study's result, which has the runs itself
  std::vector<SurfaceDiagnostic> warnings;
  std::vector<LeftOut> left_out = {};   ///< from a table of runs
  std::vector<std::string> notes = {};  ///< on that table
};

SurfaceSummary summary_of(const SurfaceReport& report);

/// As an object; missing numbers are null.
std::string to_json(const SurfaceSummary& summary);

}  // namespace repose::calibrate
