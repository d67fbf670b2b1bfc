#include <fmt/format.h>

#include "base/units.h"
#include "calibrate/statistics/bench/formulas.h"
#include "calibrate/statistics/bench/method.h"
#include "calibrate/statistics/bench/units.h"

namespace repose::calibrate {

Method restitution_method() {
  return {
      .source = "e = sqrt(h / H)",
      .columns = {{"drop_mm", "drop height H"}, {"rebound_mm", "rebound height h", kFromZero}},
      .outputs = {{"restitution", "", "coefficient of restitution e",
                   [](ReadingValues v) { return restitution_of(v[0] * kMPerMm, v[1] * kMPerMm); },
                   0, 1}},
      .error = [](ReadingValues v) -> std::optional<std::string> {
        if (v[1] <= v[0]) return std::nullopt;
        return fmt::format(
            "rebound_mm = {:g} is more than drop_mm = {:g}, but no grain rebounds higher than "
            "it fell. Fix: give both in mm, from the same point of the grain.",
            v[1], v[0]);
      },
      .validity =
          "Spin after the impact counts as loss: for a grain that is not a sphere this "
          "is not a material constant, and not the e that a simulation needs."};
}

Method sliding_method() {
  return {.source = "mu_s = tan(angle)",
          .columns = {{"angle_deg", "angle of the incline at which it slides", 0, kRightAngle_deg}},
          .outputs = {{"sliding_friction", "", "coefficient of static friction mu_s",
                       [](ReadingValues v) { return sliding_friction_of(v[0] * kRadPerDeg); }}},
          .error = {},
          .validity = "Holds for grains that cannot roll: bond two or three together."};
}

Method rolling_method() {
  return {.source = "mu_r = S sin(b) / (S cos(b) + L)",
          .columns = {{"incline_deg", "angle b of the incline", 0, kRightAngle_deg},
                      {"released_mm", "distance S down the incline"},
                      {"stopped_mm", "distance L along the flat", kFromZero}},
          .outputs = {{"rolling_friction", "", "coefficient of rolling friction mu_r",
                       [](ReadingValues v) {
                         return rolling_friction_of(v[0] * kRadPerDeg, v[1] * kMPerMm,
                                                    v[2] * kMPerMm);
                       }}},
          .error = {},
          .validity =
              "Attributes all losses to rolling friction, including those at the foot of the "
              "incline and by slipping: a simulation needs a smaller mu_r."};
}

}  // namespace repose::calibrate
