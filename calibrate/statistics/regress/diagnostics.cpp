#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.h"
#include "calibrate/statistics/regress/surface.h"

namespace repose::calibrate {
namespace {

constexpr double kSignificant = .05;

std::string place_of(const Regression& regression, const SurfacePoint& point) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < regression.factors.size(); ++i) {
    parts.push_back(fmt::format("{} = {:.4g}", regression.factors[i].name, point.natural[i]));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<double> responses_of(const Regression& regression) {
  std::vector<double> responses;
  for (const FittedRun& run : regression.runs) responses.push_back(run.response);
  return responses;
}

/// How well the same model fits the squares of the responses.
double r2_of_squares(const Regression& regression) {
  RunTable table;
  table.factors = regression.factors;
  table.levels.resize(table.factors.size());
  if (regression.blocks) table.blocks = regression.blocks->runs;
  for (const FittedRun& run : regression.runs) {
    for (std::size_t i = 0; i < table.factors.size(); ++i) {
      table.levels[i].push_back(table.factors[i].natural(run.coded[i]));
    }
    table.responses.push_back(run.response * run.response);
  }
  return regress(table, regression.model).r2;
}

/// An error's absolute value has a kink where the error is 0. Its signs: no response is negative;
/// at least a fifth of them lie below a twentieth of the largest; and either the surface
/// undershoots 0 by more than the residual's standard deviation, or the model leaves a fifth less
/// of the scatter unexplained when the responses are squared, which takes a kink away (where more
/// than 1 % is unexplained at all). A smooth response that touches 0 shows neither.
bool looks_like_absolute_error(const Regression& regression, const SurfacePoint& lowest) {
  if (regression.is_exact) return false;
  constexpr double kNearZero = .05, kMany = .2, kMuchLess = .8;
  const std::vector<double> responses = responses_of(regression);
  const auto [least, greatest] = std::minmax_element(responses.begin(), responses.end());
  if (*least < 0) return false;
  const double limit = kNearZero * *greatest;
  const auto near_zero = std::count_if(responses.begin(), responses.end(),
                                       [&](double response) { return response <= limit; });
  if (static_cast<double>(near_zero) < kMany * static_cast<double>(responses.size())) return false;
  constexpr double kNoteworthy = .01;
  const double unexplained = 1 - regression.r2;
  return lowest.value < -regression.residual_sd ||
         (unexplained > kNoteworthy && 1 - r2_of_squares(regression) < kMuchLess * unexplained);
}

void diagnostic_response(const Regression& regression, const SurfacePoint& lowest,
                         base::FieldNames names, std::vector<SurfaceDiagnostic>& diagnostics) {
  if (looks_like_absolute_error(regression, lowest)) {
    diagnostics.push_back(
        {"absolute_error",
         fmt::format("{} looks like an absolute error: it is never negative, many runs are close "
                     "to 0, and it seems to have a kink there, which no such surface can follow. "
                     "Fit the quantity itself, with its sign, and give the measured value as "
                     "{}.",
                     regression.response_name,
                     base::with_names(base::field("target value"), names))});
  }
  const std::vector<double> responses = responses_of(regression);
  if (*std::min_element(responses.begin(), responses.end()) >= 0 && lowest.value < 0) {
    diagnostics.push_back({"impossible_values",
                           fmt::format("The surface falls to {:.4g} (at {}), but no run gave less "
                                       "than 0: do not use it there.",
                                       lowest.value, place_of(regression, lowest))});
  }
}

void diagnostic_fit(const Regression& regression, std::vector<SurfaceDiagnostic>& diagnostics) {
  if (regression.is_exact) {
    diagnostics.push_back({"exact_fit",
                           "The surface fits every run exactly: without residual scatter there are "
                           "no tests and no intervals."});
    return;
  }
  if (!regression.pure_error) {
    diagnostics.push_back({"no_repeats",
                           "No two runs have the same levels, so lack of fit cannot be tested. "
                           "Repeat the centre run."});
  }
  if (regression.lack_of_fit && regression.lack_of_fit->p.value_or(1) < kSignificant) {
    diagnostics.push_back(
        {"lack_of_fit",
         fmt::format("The model does not fit: its residual is larger than the scatter of "
                     "the repeats explains (p = {:.2g}). Use a higher-order model or a "
                     "smaller box.",
                     *regression.lack_of_fit->p)});
  }
  constexpr double kMuchLess = .2;
  if (!regression.r2_predicted || regression.r2_adjusted - *regression.r2_predicted > kMuchLess) {
    diagnostics.push_back(
        {"weak_prediction",
         fmt::format("Runs left out are predicted poorly (predicted R² {}, adjusted R² "
                     "{:.2f}): single runs determine the surface.",
                     regression.r2_predicted ? fmt::format("{:.2f}", *regression.r2_predicted)
                                             : "does not exist",
                     regression.r2_adjusted)});
  }
  for (std::size_t i = 0; i < regression.factors.size(); ++i) {
    const auto p = regression.of_factor[i].p;
    if (!p || *p < kSignificant) continue;
    diagnostics.push_back(
        {"no_effect",
         fmt::format("{0} hardly depends on {1} (p = {2:.2g} for all of its terms): these "
                     "runs cannot determine {1}.",
                     regression.response_name, regression.factors[i].name, *p)});
  }
}

void diagnostic_blocks(const Regression& regression, std::vector<SurfaceDiagnostic>& diagnostics) {
  if (!regression.blocks) return;
  const auto [least, greatest] = std::minmax_element(
      regression.blocks->effects.begin(), regression.blocks->effects.end(),
      [](const BlockEffect& a, const BlockEffect& b) { return a.value < b.value; });
  diagnostics.push_back(
      {"blocks",
       fmt::format("{} is shifted by {:.4g} from {} {} to {}. The surface and its intervals are "
                   "those of the mean of these blocks; a run in another block is shifted too, by "
                   "how much they do not say.",
                   regression.response_name, greatest->value - least->value,
                   regression.blocks->runs.name, least->label, greatest->label)});
}

std::string direction_text(const Regression& regression, const CanonicalAxis& axis) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < axis.direction.size(); ++i) {
    parts.push_back(fmt::format("{:.2f} {}", axis.direction[i], regression.factors[i].name));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void diagnostic_optimum(const Regression& regression, const CanonicalForm& form,
                        std::vector<SurfaceDiagnostic>& diagnostics) {
  if (regression.is_exact) return;
  const auto is_certain = [](const CanonicalAxis& axis) { return axis.is_certain(); };
  if (std::none_of(form.axes.begin(), form.axes.end(), is_certain)) {
    diagnostics.push_back(
        {"no_curvature",
         "No curvature is significant: these runs show no optimum, and a model without "
         "squares may suffice."});
    return;
  }
  for (const CanonicalAxis& axis : form.axes) {
    if (is_certain(axis)) continue;
    diagnostics.push_back(
        {"ridge",
         fmt::format(
             "A ridge: along ({}) the curvature is {:.3g} ± {:.3g} and may be 0. There is no "
             "single optimum along it.",
             direction_text(regression, axis), axis.curvature, axis.uncertainty)});
  }
  if (form.shape == SurfaceShape::saddle) {
    diagnostics.push_back(
        {"saddle",
         "The stationary point is a saddle, neither minimum nor maximum: the lowest and "
         "highest points lie on the edge of the box, and there may be better ones "
         "beyond it."});
  }
}

void diagnostic_target(const Regression& regression, const BoxExtremes& extremes,
                       const TargetSet& target, std::vector<SurfaceDiagnostic>& diagnostics) {
  if (!target.is_reached) {
    diagnostics.push_back(
        {"target_not_reached",
         fmt::format("{:g} is not reached: within the box the surface ranges from "
                     "{:.4g} to {:.4g}. Move or widen the factors' ranges.",
                     target.target.value, extremes.least.value, extremes.greatest.value)});
    return;
  }
  const std::size_t factors = regression.factors.size();
  if (factors == 1) return;
  std::vector<std::string> open;
  for (std::size_t i = 0; i < factors; ++i) {
    const auto& ranges = target.ranges[i];
    if (ranges.size() == 1 && ranges.front() == regression.box[i]) {
      open.push_back(regression.factors[i].name);
    }
  }
  diagnostics.push_back(
      {"not_determined",
       fmt::format("One target cannot determine {} factors: a whole set of points meets it{}. "
                   "Measure something else as well, or fix factors at measured values.",
                   factors,
                   open.empty()
                       ? ""
                       : fmt::format(", and every level of {} is in it", fmt::join(open, ", ")))});
}

}  // namespace

std::vector<SurfaceDiagnostic> diagnostics_of(const Regression& regression,
                                              const std::optional<CanonicalForm>& form,
                                              const BoxExtremes& extremes,
                                              const std::optional<TargetSet>& target,
                                              base::FieldNames names) {
  std::vector<SurfaceDiagnostic> diagnostics;
  diagnostic_response(regression, extremes.least, names, diagnostics);
  diagnostic_fit(regression, diagnostics);
  diagnostic_blocks(regression, diagnostics);
  if (form) diagnostic_optimum(regression, *form, diagnostics);
  if (target) diagnostic_target(regression, extremes, *target, diagnostics);
  return diagnostics;
}

}  // namespace repose::calibrate
