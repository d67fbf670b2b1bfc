#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/statistics/bench/bench.h"
#include "calibrate/statistics/bench/method.h"

/// Plates covered with glued grains: a bed of grains has no formula, the simulation stands for it.

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

Method heap_method() {
  return {.source = "mean of the heaps",
          .columns = {{"angle_deg", "angle of repose", kFromZero, kRightAngle_deg}},
          .outputs = {{"angle_of_repose", "deg", "angle of repose",
                       [](ReadingValues v) { return v[0]; }, 0, kRightAngle_deg}},
          .error = {},
          .validity =
              "No material constant: it belongs to heaps of this size, made on this base in this "
              "way."};
}

namespace {

double density(ReadingValues v) { return density_of(v[0] * kKgPerG, (v[2] - v[1]) * kM3PerMl); }

double young(ReadingValues v) {
  const double radius_m = v[1] / 2 * kMPerMm;
  return young_modulus_of(v[0], std::numbers::pi * radius_m * radius_m, v[3] * kMPerMm,
                          v[2] * kMPerMm);
}

double poisson(ReadingValues v) { return poisson_ratio_of(v[3], v[2], v[1], v[0]); }

}  // namespace

Method density_method() {
  return {
      .source = "rho = m / V",
      .columns = {{"mass_g", "mass m"},
                  {"before_ml", "liquid's level before", kFromZero},
                  {"after_ml", "and with the grain in it: V is the difference"}},
      .outputs = {{"density", "kg/m³", "density rho", density}},
      .error = [](ReadingValues v) -> std::optional<base::Fault> {
        if (v[2] <= v[1]) {
          return base::Fault{
              .subject = "after_ml",
              .value = fmt::format(
                  "= {:g} is not more than before_ml = {:g}: no liquid was displaced", v[2], v[1]),
              .fix = "read the level again, or leave the reading out."};
        }
        constexpr double kLightest = 10, kHeaviest = 25000;  // foam, osmium
        const double density_kg_m3 = density(v);
        if (density_kg_m3 >= kLightest && density_kg_m3 <= kHeaviest) return std::nullopt;
        return base::Fault{
            .value = fmt::format("{:g} g in {:g} ml are {:.4g} kg/m³, and no grain is", v[0],
                                 v[2] - v[1], density_kg_m3),
            .fix = "give the mass in g and the levels in ml."};
      },
      .validity = "Air that clings to the grain, and liquid that it soaks up, count as well."};
}

Method young_method() {
  return {.source = "E = (F / A) / (compression / height)",
          .columns = {{"force_n", "force F"},
                      {"spot_mm", "diameter of the round contact spot, area A"},
                      {"height_mm", "height of the grain, unloaded"},
                      {"compression_mm", "how much lower it is under the force"}},
          .outputs = {{"young_modulus", "Pa", "Young's modulus E", young}},
          .error = [](ReadingValues v) -> std::optional<base::Fault> {
            if (v[3] < v[2]) return std::nullopt;
            return base::Fault{
                .subject = "compression_mm",
                .value = fmt::format("= {:g} is not less than height_mm = {:g}", v[3], v[2]),
                .fix = "give both in mm, and the compression alone, not what is left."};
          },
          .validity = "An apparent modulus: stress and strain of a whole grain are not uniform."};
}

Method poisson_method() {
  return {.source = "nu = lateral strain / axial strain",
          .columns = {{"height_mm", "size along the force, unloaded"},
                      {"shortening_mm", "how much shorter it gets"},
                      {"width_mm", "size across the force, unloaded"},
                      {"widening_mm", "how much wider it gets",
                       -std::numeric_limits<double>::infinity()}},
          .outputs = {{"poisson_ratio", "", "Poisson's ratio nu", poisson, -1, .5}},
          .error = [](ReadingValues v) -> std::optional<base::Fault> {
            if (v[1] >= v[0]) {
              return base::Fault{
                  .subject = "shortening_mm",
                  .value = fmt::format("= {:g} is not less than height_mm = {:g}", v[1], v[0]),
                  .fix = "give both in mm, and the shortening alone, not what is left."};
            }
            const double nu = poisson(v);
            if (nu > -1 && nu < .5) return std::nullopt;
            return base::Fault{
                .value = fmt::format("Poisson's ratio would be {:.4g}, and is between -1 and 0.5 "
                                     "for every stable isotropic body",
                                     nu),
                .fix =
                    "see that the height is along the force and the width across it; if they are, "
                    "the grain has yielded or cracked: leave the reading out."};
          },
          .validity = "Of an isotropic, elastic body under small strain."};
}

Method size_method() {
  return {
      .source = "D = (L W T)^(1/3), sphericity = D / L",
      .columns = {{"length_mm", "length L"},
                  {"width_mm", "width W"},
                  {"thickness_mm", "thickness T"}},
      .outputs = {{"length", "mm", "length L", [](ReadingValues v) { return v[0]; }},
                  {"width", "mm", "width W", [](ReadingValues v) { return v[1]; }},
                  {"thickness", "mm", "thickness T", [](ReadingValues v) { return v[2]; }},
                  {"mean_diameter", "mm", "geometric mean diameter D",
                   [](ReadingValues v) { return geometric_mean_diameter_of(v[0], v[1], v[2]); }},
                  {"sphericity", "", "sphericity",
                   [](ReadingValues v) { return sphericity_of(v[0], v[1], v[2]); }, 0, 1}},
      .error = [](ReadingValues v) -> std::optional<base::Fault> {
        if (v[0] >= std::max(v[1], v[2])) return std::nullopt;
        return base::Fault{.subject = "length_mm",
                           .value = fmt::format("= {:g} is not the longest of {:g}, {:g} and {:g}, "
                                                "and sphericity is defined by the longest",
                                                v[0], v[0], v[1], v[2]),
                           .fix = "turn the grain, or write the longest first."};
      },
      .validity = "The standard deviations are how much grains differ, not errors."};
}

namespace {

constexpr const char* kNoConstant =
    "No material constant: glued grains interlock. Calibrate a study with these readings.";

Method angle_method(const std::string& name, const std::string& what) {
  return {
      .source = "mean of the readings",
      .columns = {{"angle_deg", what, 0, kRightAngle_deg}},
      .outputs = {{name, "deg", what, [](ReadingValues v) { return v[0]; }, 0, kRightAngle_deg}},
      .error = {},
      .validity = kNoConstant};
}

}  // namespace

Method drop_on_grains_method() {
  Method method = restitution_method();
  method.source = "mean of the readings";
  method.outputs = {{"rebound", "mm", "height of rebound from glued grains",
                     [](ReadingValues v) { return v[1]; }}};
  method.optional_columns = {in_air_column()};
  method.remarks = {};
  method.error_of_all = {};
  method.validity =
      "No material constant: on a bed most grains are thrown aside. Calibrate a study with these "
      "readings.";
  return method;
}

Method tilt_on_grains_method() {
  return angle_method("angle_of_sliding", "tilt at which bonded grains slide off");
}

Method roll_on_grains_method() {
  return angle_method("angle_of_rolling", "tilt at which a single grain rolls off");
}

}  // namespace repose::calibrate
