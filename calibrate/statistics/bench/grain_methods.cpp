#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/statistics/bench/bench.h"
#include "calibrate/statistics/bench/method.h"

namespace repose::calibrate {

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
      .name = "density",
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
  return {.name = "young",
          .source = "E = (F / A) / (compression / height)",
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
  return {.name = "poisson",
          .source = "nu = lateral strain / axial strain",
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
      .name = "size",
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

}  // namespace repose::calibrate
