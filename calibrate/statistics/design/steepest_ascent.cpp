#include "calibrate/statistics/design/steepest_ascent.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/input_error.h"

namespace repose::calibrate {

Design steepest_ascent(const Regression& regression, int runs, double stride, bool descends) {
  double steepest = 0;
  for (const Coefficient& coefficient : regression.coefficients) {
    if (!coefficient.term.empty()) steepest = std::max(steepest, std::abs(coefficient.value));
  }
  base::Faults errors;
  errors.require(regression.model == SurfaceModel::linear,
                 {.value = "steepest ascent follows a plane", .fix = "fit a linear model."});
  errors.require(std::isfinite(stride) && stride > 0,
                 {.subject = "stride",
                  .value = fmt::format("= {:g}:", stride),
                  .rule = "must be more than 0",
                  .fix = "0.5 is half of the range from the centre to a factor's high level."});
  errors.require(steepest > 0,
                 {.value = "the fitted surface is level: no direction leads up or down",
                  .fix = "name factors that matter."});
  errors.throw_if_any();

  std::vector<std::string> names;
  std::vector<double> start, step;
  for (std::size_t i = 0; i < regression.factors.size(); ++i) {
    const Factor& factor = regression.factors[i];
    const double slope = regression.coefficients[i + 1].value;  // after the constant
    names.push_back(factor.name);
    start.push_back(factor.centre());
    step.push_back((descends ? -1 : 1) * stride * slope / steepest * factor.half_range());
  }
  return line_of_runs(names, start, step, runs);
}

}  // namespace repose::calibrate
