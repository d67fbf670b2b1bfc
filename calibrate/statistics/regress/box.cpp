#include "calibrate/statistics/regress/box.h"

#include <limits>
#include <optional>

#include <Eigen/LU>

namespace repose::calibrate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Each variable is held at its lower or upper bound, or free.
enum class Hold { lower, upper, free };

/// The point of one face, its free variables free of slope; none if it is not within the box or not
/// a single point. In the latter case the surface has the same value, or a lower one, on the rim.
std::optional<VectorXd> face_point(const Quadratic& surface, const Box& box,
                                   const std::vector<Hold>& holds) {
  VectorXd point = VectorXd::Zero(surface.gradient.size());
  std::vector<Index> free;
  for (std::size_t i = 0; i < holds.size(); ++i) {
    if (holds[i] == Hold::free) {
      free.push_back(static_cast<Index>(i));
    } else {
      point[static_cast<Index>(i)] = box[i][holds[i] == Hold::upper ? 1 : 0];
    }
  }
  if (free.empty()) return point;
  const MatrixXd curvature = surface.curvature(free, free);
  const VectorXd slope = (surface.gradient + 2 * surface.curvature * point)(free);
  const Eigen::FullPivLU<MatrixXd> solver(curvature);
  if (!solver.isInvertible()) return std::nullopt;
  const VectorXd solution = solver.solve(-slope / 2);
  for (std::size_t k = 0; k < free.size(); ++k) {
    const auto& [low, high] = box[static_cast<std::size_t>(free[k])];
    const double value = solution[static_cast<Index>(k)];
    if (!(value >= low && value <= high)) return std::nullopt;
    point[free[k]] = value;
  }
  return point;
}

/// The next face, counting in threes; false after the last.
bool advance(std::vector<Hold>& holds) {
  for (Hold& hold : holds) {
    if (hold == Hold::lower) {
      hold = Hold::upper;
      return true;
    }
    if (hold == Hold::upper) {
      hold = Hold::free;
      return true;
    }
    hold = Hold::lower;
  }
  return false;
}

}  // namespace

VectorXd lowest_in_box(const Quadratic& surface, const Box& box) {
  std::vector<Hold> holds(box.size(), Hold::lower);
  VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  do {
    const auto point = face_point(surface, box, holds);
    if (!point) continue;
    const double value = surface(*point);
    if (value < least) {
      least = value;
      best = *point;
    }
  } while (advance(holds));
  return best;
}

SurfacePoint point_at(const Regression& regression, const VectorXd& coded) {
  SurfacePoint point;
  point.coded = {coded.begin(), coded.end()};
  for (std::size_t i = 0; i < point.coded.size(); ++i) {
    point.natural.push_back(regression.factors[i].natural(point.coded[i]));
  }
  point.value = regression.predicted(point.coded);
  point.uncertainty = regression.student_t * regression.standard_error(point.coded);
  return point;
}

BoxExtremes extremes_in_box(const Regression& regression) {
  const Quadratic surface = surface_of(regression);
  return {point_at(regression, lowest_in_box(surface, regression.box)),
          point_at(regression, lowest_in_box(-surface, regression.box))};
}

}  // namespace repose::calibrate
