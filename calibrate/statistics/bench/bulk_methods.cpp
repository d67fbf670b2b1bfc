#include <cmath>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/statistics/bench/formulas.h"
#include "calibrate/statistics/bench/method.h"
#include "calibrate/statistics/bench/units.h"

namespace repose::calibrate {
namespace {

/// Beads of foamed polystyrene have 8 and more, osmium without any gaps has 22,590.
constexpr double kLightestFill_kg_m3 = 5, kHeaviestFill_kg_m3 = 22590;

}  // namespace

Method fill_method() {
  return {
      .source = "mean of the fillings",
      .columns = {{"bulk_density_kg_m3", "mass in the tube by the tube's volume",
                   kLightestFill_kg_m3, kHeaviestFill_kg_m3}},
      .outputs = {{"bulk_density", "kg/m3", "bulk density", [](ReadingValues v) { return v[0]; }}},
      .error = {},
      .validity = "No material constant: it belongs to this tube, filled in this way."};
}

Method pendulum_method() {
  return {
      .source = "e = 2 sin(a / 2) / sin(b / 2) - 1",
      .columns = {{"release_deg", "angle b that the one is let go from", 0, 90.000001},
                  {"swing_deg", "angle a that the struck one swings to", kFromZero,
                   kRightAngle_deg}},
      .outputs = {{"restitution", "", "coefficient of restitution e",
                   [](ReadingValues v) {
                     return pendulum_restitution_of(v[0] * kDegree, v[1] * kDegree);
                   },
                   0, 1}},
      .error = [](ReadingValues v) -> std::optional<base::Fault> {
        if (v[1] <= v[0]) return std::nullopt;
        return base::Fault{.subject = "swing_deg",
                           .value = fmt::format("= {:g} is more than release_deg = {:g}, and the "
                                                "struck grain swings no higher than the other fell",
                                                v[1], v[0]),
                           .fix = "use two grains of the same mass on strings of the same length."};
      },
      .validity =
          "Holds for equal balls that meet head-on: what grains that are no spheres lose to spin "
          "counts as loss."};
}

Method draw_down_method() {
  constexpr double kAll = 100;
  return {.source = "mean of the discharges",
          .columns = {{"discharged_percent", "mass that runs out, by that of the fill, times 100",
                       0, kAll}},
          .outputs = {{"discharged_mass", "%", "mass that runs out",
                       [](ReadingValues v) { return v[0]; }, 0, kAll}},
          .error = {},
          .validity = "No material constant: it belongs to these boxes, filled to this height."};
}

}  // namespace repose::calibrate
