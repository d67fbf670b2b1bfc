#include "calibrate/result/surface_summary.h"

namespace repose::calibrate {
namespace {

std::vector<SurfaceFactor> factors_of(const Regression& fit) {
  std::vector<SurfaceFactor> factors;
  for (std::size_t i = 0; i < fit.factors.size(); ++i) {
    const Factor& factor = fit.factors[i];
    const auto& [low, high] = fit.box[i];
    factors.push_back({factor, {factor.natural(low), factor.natural(high)}, fit.of_factor[i]});
  }
  return factors;
}

std::vector<SurfaceTerm> terms_in(const Regression& fit) {
  std::vector<SurfaceTerm> terms;
  for (const Coefficient& coefficient : fit.coefficients) {
    terms.push_back({.term = name_of(coefficient.term, fit.factors),
                     .value = coefficient.value,
                     .standard_error = coefficient.standard_error,
                     .t = coefficient.t,
                     .p = coefficient.p,
                     .interval = coefficient.interval,
                     .partial_sum_of_squares = coefficient.partial.sum_of_squares,
                     .natural = coefficient.natural});
  }
  return terms;
}

std::vector<SurfaceCrossing> crossings_of(const std::vector<Crossing>& crossings) {
  std::vector<SurfaceCrossing> all;
  for (const Crossing& crossing : crossings) {
    all.push_back({.factor = crossing.factor,
                   .levels = crossing.point.natural,
                   .interval = crossing.interval});
  }
  return all;
}

SurfaceTarget target_of(const Regression& fit, const TargetSet& set) {
  SurfaceTarget target{.value = set.target.value,
                       .uncertainty = set.target.uncertainty,
                       .is_reached = set.is_reached,
                       .ranges = {},
                       .through_centre = crossings_of(set.through_centre),
                       .points = crossings_of(set.grid)};
  for (std::size_t i = 0; i < set.ranges.size(); ++i) {
    auto& intervals = target.ranges.emplace_back();
    for (const auto& [low, high] : set.ranges[i]) {
      intervals.push_back({fit.factors[i].natural(low), fit.factors[i].natural(high)});
    }
  }
  return target;
}

}  // namespace

SurfaceSummary summary_of(const SurfaceReport& report) {
  const Regression& fit = report.fit;
  SurfaceSummary summary{.response = fit.response_name,
                         .model = fit.model,
                         .factors = factors_of(fit),
                         .coefficients = terms_in(fit),
                         .blocks = {},
                         .anova = {.blocks = {},
                                   .model = fit.explained,
                                   .residual = fit.residual,
                                   .lack_of_fit = fit.lack_of_fit,
                                   .pure_error = fit.pure_error,
                                   .total = fit.total},
                         .residual_sd = fit.residual_sd,
                         .r2 = fit.r2,
                         .r2_adjusted = fit.r2_adjusted,
                         .r2_predicted = fit.r2_predicted,
                         .press = fit.press,
                         .canonical = report.form,
                         .extremes = report.extremes,
                         .target = {},
                         .runs = fit.runs,
                         .warnings = report.diagnostics,
                         .left_out = {},
                         .notes = {}};
  if (fit.blocks) {
    summary.blocks = SurfaceBlocks{fit.blocks->runs.name, fit.blocks->effects};
    summary.anova.blocks = fit.blocks->variance;
  }
  if (report.target) summary.target = target_of(fit, *report.target);
  return summary;
}

}  // namespace repose::calibrate
