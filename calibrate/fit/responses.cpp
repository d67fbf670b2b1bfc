#include "calibrate/fit/responses.h"

#include <cstddef>

#include "calibrate/fit/unit_box.h"

namespace repose::calibrate {
namespace {

constexpr std::size_t kCurvePlaces = 41;
constexpr std::size_t kSurfacePlaces = 25;  // along each side

double fraction(std::size_t place, std::size_t places) {
  return static_cast<double>(place) / static_cast<double>(places - 1);
}

std::vector<double> values_along(const Parameter& parameter, std::size_t places) {
  std::vector<double> values;
  for (std::size_t k = 0; k < places; ++k) {
    const double value = parameter.min + fraction(k, places) * (parameter.max - parameter.min);
    values.push_back(rounded(parameter, value));
  }
  return values;
}

const std::vector<std::size_t>& with_effect(const Problem& problem, std::size_t observable) {
  return experiment_named(problem, problem.observables[observable].experiment).parameters;
}

ResponseCurve curve_of(const Problem& problem, const Solution& solution, std::size_t observable,
                       std::size_t parameter) {
  const Surrogate& surrogate = solution.misfit.surrogates()[observable];
  ResponseCurve curve{.observable = observable,
                      .parameter = parameter,
                      .values = values_along(problem.parameters[parameter], kCurvePlaces),
                      .simulated = {},
                      .uncertainty = {},
                      .scatter = {}};
  Point point = solution.best.point;
  for (std::size_t k = 0; k < kCurvePlaces; ++k) {
    point[parameter] = fraction(k, kCurvePlaces);
    curve.simulated.push_back(surrogate.simulated(point));
    curve.uncertainty.push_back(surrogate.uncertainty(point));
    curve.scatter.push_back(surrogate.warp().scatter(surrogate.at(point, false).mean));
  }
  return curve;
}

ResponseSurface surface_of(const Problem& problem, const Solution& solution, std::size_t observable,
                           std::size_t x, std::size_t y) {
  const Surrogate& surrogate = solution.misfit.surrogates()[observable];
  ResponseSurface surface{.observable = observable,
                          .x_parameter = x,
                          .y_parameter = y,
                          .x = values_along(problem.parameters[x], kSurfacePlaces),
                          .y = values_along(problem.parameters[y], kSurfacePlaces),
                          .simulated = {}};
  Point point = solution.best.point;
  for (std::size_t row = 0; row < kSurfacePlaces; ++row) {
    point[y] = fraction(row, kSurfacePlaces);
    std::vector<double>& heights = surface.simulated.emplace_back();
    for (std::size_t column = 0; column < kSurfacePlaces; ++column) {
      point[x] = fraction(column, kSurfacePlaces);
      heights.push_back(surrogate.simulated(point));
    }
  }
  return surface;
}

}  // namespace

std::vector<ResponseCurve> response_curves(const Problem& problem, const Solution& solution) {
  std::vector<ResponseCurve> curves;
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    for (const std::size_t parameter : with_effect(problem, i)) {
      curves.push_back(curve_of(problem, solution, i, parameter));
    }
  }
  return curves;
}

std::vector<ResponseSurface> response_surfaces(const Problem& problem, const Solution& solution) {
  std::vector<ResponseSurface> surfaces;
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    const std::vector<std::size_t>& parameters = with_effect(problem, i);
    for (std::size_t x = 0; x < parameters.size(); ++x) {
      for (std::size_t y = x + 1; y < parameters.size(); ++y) {
        surfaces.push_back(surface_of(problem, solution, i, parameters[x], parameters[y]));
      }
    }
  }
  return surfaces;
}

}  // namespace repose::calibrate
