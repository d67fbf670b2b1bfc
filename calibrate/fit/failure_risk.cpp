#include "calibrate/fit/failure_risk.h"

#include <cmath>

namespace repose::calibrate {
namespace {

constexpr double kWidth = .1;           // of the box, times the root of its dimensions
constexpr double kUnknownWeight = .02;  // of a success assumed everywhere

}  // namespace

Risk FailureRisk::at(const Point& point) const {
  Risk risk;
  risk.gradient.assign(point.size(), 0);
  if (!any()) return risk;
  const std::vector<std::size_t>& seen = attempts_.parameters;
  const double width2 = kWidth * kWidth * static_cast<double>(seen.size());
  double all = kUnknownWeight;
  double failed = 0;
  Point all_gradient(point.size(), 0);
  Point failed_gradient(point.size(), 0);
  for (std::size_t run = 0; run < attempts_.places.size(); ++run) {
    double distance2 = 0;
    for (std::size_t c = 0; c < seen.size(); ++c) {
      const double off = point[seen[c]] - attempts_.places[run][c];
      distance2 += off * off;
    }
    const double weight = std::exp(-distance2 / (2 * width2));
    all += weight;
    if (attempts_.failed[run]) failed += weight;
    for (std::size_t c = 0; c < seen.size(); ++c) {
      const double slope = -weight * (point[seen[c]] - attempts_.places[run][c]) / width2;
      all_gradient[seen[c]] += slope;
      if (attempts_.failed[run]) failed_gradient[seen[c]] += slope;
    }
  }
  risk.fraction = failed / all;
  for (std::size_t i = 0; i < point.size(); ++i) {
    risk.gradient[i] = (failed_gradient[i] - risk.fraction * all_gradient[i]) / all;
  }
  return risk;
}

}  // namespace repose::calibrate
