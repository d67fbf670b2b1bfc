#pragma once

#include <string>
#include <vector>

#include "calibrate/statistics/regress/regression.h"

namespace repose::calibrate {

/// The central composite design of the hazelnut study (its table 2): x1 restitution, x2 static and
/// x3 rolling friction, coded; the response is the relative error of the angle, %.
inline RunTable hazelnut_runs() {
  constexpr double kAlpha = 1.682;
  RunTable table;
  table.name = "hazelnut";
  table.factors = {{"x1"}, {"x2"}, {"x3"}};
  table.levels.resize(3);
  const auto add = [&](double x1, double x2, double x3) {
    table.levels[0].push_back(x1);
    table.levels[1].push_back(x2);
    table.levels[2].push_back(x3);
  };
  for (const double x3 : {-1, 1}) {
    for (const double x2 : {-1, 1}) {
      for (const double x1 : {-1, 1}) add(x1, x2, x3);
    }
  }
  for (const double x : {-kAlpha, kAlpha}) add(x, 0, 0);
  for (const double x : {-kAlpha, kAlpha}) add(0, x, 0);
  for (const double x : {-kAlpha, kAlpha}) add(0, 0, x);
  for (int k = 0; k < 6; ++k) add(0, 0, 0);
  table.response_name = "error";
  table.responses = {48.10, 51.65, 3.63,  3.55,  24.16, 20.78, 1.54, 19.37, 2.52, .51,
                     64.73, .51,   26.38, 19.37, .51,   11.03, .51,  2.61,  .56,  .51};
  return table;
}

}  // namespace repose::calibrate
