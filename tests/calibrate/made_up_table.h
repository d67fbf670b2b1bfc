#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "calibrate/fit/points.h"

/// A table of runs of a made-up engine: angle and bulk density follow closed formulas, plus noise.
namespace repose::calibrate::test {

/// Depends on sliding and rolling friction together, not on restitution.
inline double angle_of(double sliding, double rolling) {
  return 6 + 52 * std::sqrt(sliding * (rolling + .05));
}

/// Depends on another combination of the two.
inline double density_of(double sliding, double rolling) {
  return 860 - 120 * sliding - 40 * rolling;
}

inline constexpr double kAngleNoise = .6;  // of a single run
inline constexpr double kDensityNoise = 3;

struct MadeUpTable {
  int rows = 30;
  int repeats = 2;   ///< number of runs averaged in a row
  double noise = 1;  ///< factor on the noise of angle and density
};

/// sliding 0.1 ... 0.7, rolling 0 ... 0.3, restitution 0.2 ... 0.8.
inline std::vector<std::vector<double>> made_up_places(int rows) {
  std::vector<std::vector<double>> places;
  for (int k = 0; k < rows; ++k) {
    const Point point = sequence_point(static_cast<std::size_t>(k), 3);
    places.push_back({.1 + .6 * point[0], .3 * point[1], .2 + .6 * point[2]});
  }
  return places;
}

inline std::string made_up_rows(const MadeUpTable& made = {}) {
  Random random(4);
  std::string text = "sliding,rolling,restitution,angle,angle_sd,density,n\n";
  for (const std::vector<double>& at : made_up_places(made.rows)) {
    double mean = 0, squares = 0, density = 0;
    std::vector<double> angles;
    for (int k = 0; k < made.repeats; ++k) {
      angles.push_back(angle_of(at[0], at[1]) + made.noise * kAngleNoise * random.normal());
      density +=
          (density_of(at[0], at[1]) + made.noise * kDensityNoise * random.normal()) / made.repeats;
    }
    for (const double angle : angles) mean += angle / made.repeats;
    for (const double angle : angles) squares += (angle - mean) * (angle - mean);
    const double sd = made.repeats > 1 ? std::sqrt(squares / (made.repeats - 1)) : 0;
    text += fmt::format("{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{}\n", at[0], at[1], at[2], mean,
                        sd, density, made.repeats);
  }
  return text;
}

inline constexpr const char* kMadeUpParameters =
    "[parameter]\n"
    "sliding = { min = 0.1, max = 0.7 }\n"
    "rolling = { min = 0, max = 0.3 }\n"
    "restitution = { min = 0.2, max = 0.8 }\n";

/// The angle at about sliding .4 and rolling .13.
inline constexpr double kMeasuredAngle = 20;

inline std::string made_up_study(const std::string& more = "") {
  return std::string(kMadeUpParameters) +
         "[measured]\n"
         "angle = { mean = 20, sd = 1, n = 1, unit = \"deg\" }\n" +
         more;
}

inline constexpr const char* kMeasuredDensity = "density = { mean = 806.8, sd = 2, n = 4 }\n";

}  // namespace repose::calibrate::test
