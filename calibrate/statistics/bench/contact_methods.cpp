#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "base/air_drag.h"
#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/statistics/bench/bench.h"
#include "calibrate/statistics/bench/method.h"

namespace repose::calibrate {
namespace {

constexpr const char* kDiameter = "diameter_mm";
constexpr const char* kDensity = "density_kg_m3";

// Columns of restitution, and of rolling.
constexpr std::size_t kDrop = 0, kRebound = 1;
constexpr std::size_t kIncline = 0, kReleased = 1, kStopped = 2;

double mean_of(std::span<const ReadingValues> readings,
               const std::function<double(ReadingValues)>& value_of) {
  double sum = 0;
  for (const ReadingValues& reading : readings) sum += value_of(reading);
  return sum / static_cast<double>(readings.size());
}

/// Whether heights are those of a fall in air.
bool is_in_air(ReadingValues v) { return v.given(std::string(kInAirColumn)).value_or(1) != 0; }

/// std::nullopt: its drag is unknown, or there is none.
std::optional<base::FallingGrain> grain_in_air(ReadingValues v) {
  const auto diameter_mm = v.given(kDiameter);
  const auto density = v.given(kDensity);
  if (!diameter_mm || !density || !is_in_air(v)) return std::nullopt;
  return base::FallingGrain{.diameter_m = *diameter_mm * kMPerMm, .density_kg_m3 = *density};
}

double restitution_without_air(ReadingValues v, const base::FallingGrain& grain) {
  const double drop_m = v[kDrop] * kMPerMm;
  return restitution_of(drop_m, base::rise_without_air_m(grain, drop_m, v[kRebound] * kMPerMm));
}

double restitution_as_read(ReadingValues v) {
  return restitution_of(v[kDrop] * kMPerMm, v[kRebound] * kMPerMm);
}

double restitution(ReadingValues v) {
  const auto grain = grain_in_air(v);
  return grain ? restitution_without_air(v, *grain) : restitution_as_read(v);
}

std::optional<base::Fault> drop_error(ReadingValues v) {
  const double in_air = v.given(std::string(kInAirColumn)).value_or(1);
  if (in_air != 0 && in_air != 1) {
    return base::Fault{.value = fmt::format("{} = {:g}", kInAirColumn, in_air),
                       .rule = "1 for heights read in air, 0 for those of a fall without it",
                       .fix = "take the column out for 1."};
  }
  if (v[kRebound] > v[kDrop]) {
    return base::Fault{
        .subject = "rebound_mm",
        .value = fmt::format(
            "= {:g} is more than drop_mm = {:g}, but no grain rebounds higher than it fell",
            v[kRebound], v[kDrop]),
        .fix = "give both in mm, from the same point of the grain."};
  }
  if (v.given(kDiameter).has_value() != v.given(kDensity).has_value()) {
    return base::Fault{
        .value = fmt::format("{} is given without {}", v.given(kDiameter) ? kDiameter : kDensity,
                             v.given(kDiameter) ? kDensity : kDiameter),
        .rule = "the drag of the air follows from both",
        .fix = "give both, or neither."};
  }
  const auto grain = grain_in_air(v);
  if (!grain || restitution_without_air(v, *grain) <= 1) return std::nullopt;
  return base::Fault{.subject = "rebound_mm",
                     .value = fmt::format("= {:g} after drop_mm = {:g}: a grain of {} = {:g} and "
                                          "{} = {:g} cannot rise so high in air",
                                          v[kRebound], v[kDrop], kDiameter, *v.given(kDiameter),
                                          kDensity, *v.given(kDensity)),
                     .fix = "check the grain's diameter and density."};
}

/// Heights with and without air drag are different quantities, so their mean is meaningless.
std::optional<base::Fault> mixed_air_error(std::span<const ReadingValues> readings) {
  const auto in_air = std::ranges::count_if(readings, is_in_air);
  if (in_air == 0 || in_air == std::ssize(readings) ||
      grain_in_air(*std::ranges::find_if(readings, is_in_air))) {
    return std::nullopt;
  }
  return base::Fault{
      .value =
          fmt::format("{} of {} heights were read in air, the others are free of its drag ({} = 0)",
                      in_air, readings.size(), kInAirColumn),
      .rule = "such heights have no common mean until the drag is taken out",
      .fix = fmt::format("give {} and {}, too, or make two tables of them.", kDiameter, kDensity)};
}

std::vector<std::string> remarks_on_air(std::span<const ReadingValues> readings) {
  const auto in_air = std::ranges::count_if(readings, is_in_air);
  if (in_air == 0) return {"The heights are free of the air's drag (in_air = 0)."};
  if (in_air < std::ssize(readings)) {
    return {fmt::format(
        "{} of {} heights were read in air, the others are free of its drag (in_air = 0): it is "
        "taken out of the former alone, by each reading's {} and {}.",
        in_air, readings.size(), kDiameter, kDensity)};
  }
  const double as_read = mean_of(readings, restitution_as_read);
  const auto grain = grain_in_air(readings.front());
  if (grain) {
    const double without_air = mean_of(readings, restitution);
    const double u = base::drag_uncertainty(*grain);
    return {fmt::format(
        "The air's drag is taken out, as of a sphere of {:g} mm and {:g} kg/m3: without that e "
        "would be {:.4g}. The drag is known to {:.0f} % (standard uncertainty), e to ± {:.2g} by "
        "it, which the interval leaves out. Elongated grains are slowed more: repose calibrate "
        "goes by their shape.",
        *readings.front().given(kDiameter), grain->density_kg_m3, as_read, 100 * u,
        u * std::abs(without_air - as_read))};
  }
  constexpr base::FallingGrain kSmall{.diameter_m = .002, .density_kg_m3 = 1200};
  constexpr base::FallingGrain kLarge{.diameter_m = .01, .density_kg_m3 = 1200};
  const auto of = [&](const base::FallingGrain& one) {
    return mean_of(readings, [&](ReadingValues v) { return restitution_without_air(v, one); });
  };
  return {fmt::format(
      "The air's drag is neglected, so that e is too low: these heights mean {:.4g} for a grain of "
      "2 mm and 1200 kg/m3, {:.4g} for one of 10 mm. Fix: give {} and {}, too.",
      of(kSmall), of(kLarge), kDiameter, kDensity)};
}

double rolling_friction(ReadingValues v) {
  const double incline = v[kIncline] * kDegree;
  const double released_m = v[kReleased] * kMPerMm;
  const double stopped_m = v[kStopped] * kMPerMm;
  const auto diameter_mm = v.given(kDiameter);
  return diameter_mm
             ? rolling_friction_of(incline, released_m, stopped_m, *diameter_mm * kMPerMm / 2)
             : rolling_friction_of(incline, released_m, stopped_m);
}

double foot_mm(ReadingValues v, double diameter_mm) {
  return foot_distance_m(v[kIncline] * kDegree, diameter_mm * kMPerMm / 2) * kMmPerM;
}

/// Whether the grain stayed on the incline, however often it was released.
bool has_stayed(ReadingValues v) { return v[kStopped] == 0; }

/// A ball in the corner touches both planes: it must be released above that, and stops beyond
/// unless it stays where it is.
bool can_stop_there(ReadingValues v, double diameter_mm) {
  const double foot = foot_mm(v, diameter_mm);
  return v[kReleased] > foot && (has_stayed(v) || v[kStopped] > foot);
}

std::optional<base::Fault> roll_error(ReadingValues v) {
  const auto diameter_mm = v.given(kDiameter);
  if (!diameter_mm || can_stop_there(v, *diameter_mm)) return std::nullopt;
  const bool is_released = v[kReleased] <= v[kStopped] || has_stayed(v);
  return base::Fault{
      .value = fmt::format(
          "{} = {:g}: a ball of {} = {:g} in the corner lies {:.4g} mm from the foot, d/2 tan(b/2)",
          is_released ? "released_mm" : "stopped_mm", is_released ? v[kReleased] : v[kStopped],
          kDiameter, *diameter_mm, foot_mm(v, *diameter_mm)),
      .rule = "more than that, or stopped_mm = 0 for one that never left the incline",
      .fix =
          "measure from the foot to the ball's centre, along the plane that it lies on, or correct "
          "the diameter."};
}

std::string remark_on_foot(std::span<const ReadingValues> readings) {
  const double neglected = mean_of(readings, [](ReadingValues v) {
    return rolling_friction_of(v[kIncline] * kDegree, v[kReleased] * kMPerMm,
                               v[kStopped] * kMPerMm);
  });
  if (readings.front().given(kDiameter)) {
    return fmt::format(
        "What a ball loses at the foot of the incline is taken out: without that mu_r would be "
        "{:.4g}.",
        neglected);
  }
  const auto with_foot = [&](double diameter_m) {
    return mean_of(readings, [&](ReadingValues v) {
      return rolling_friction_of(v[kIncline] * kDegree, v[kReleased] * kMPerMm,
                                 v[kStopped] * kMPerMm, diameter_m / 2);
    });
  };
  constexpr double kLarge_m = .02;
  std::string text = fmt::format(
      "What is lost at the foot of the incline is neglected, so that mu_r is too high: these "
      "distances mean {:.4g} for a ball that is small beside them",
      with_foot(0));
  if (std::ranges::all_of(readings,
                          [](ReadingValues v) { return can_stop_there(v, kLarge_m * kMmPerM); })) {
    text += fmt::format(" and {:.4g} for one of 20 mm", with_foot(kLarge_m));
  }
  return text + fmt::format(". Fix: give {}, too.", kDiameter);
}

std::vector<std::string> remarks_on_roll(std::span<const ReadingValues> readings) {
  std::vector<std::string> remarks = {remark_on_foot(readings)};
  const auto stayed = std::ranges::count_if(readings, has_stayed);
  if (stayed > 0) {
    remarks.push_back(fmt::format(
        "{} of {} stayed on the incline (stopped_mm = 0). Such a grain says only that mu_r is tan "
        "b "
        "or more, and counts as tan b: the mean is a lower bound. Fix: a steeper incline. repose "
        "calibrate needs none: its simulated grains that stay count as 0, too.",
        stayed, readings.size()));
  }
  return remarks;
}

ReadingColumn in_air_column() {
  constexpr double kOverOne = 1.000001;
  return {std::string(kInAirColumn), "answer, 1 for heights read in air and 0 for others,",
          kFromZero, kOverOne};
}

ReadingColumn uncertainty_of(const char* column) {
  return {uncertainty_column(column), fmt::format("half-width of the interval of {}", column),
          kFromZero};
}

}  // namespace

Method restitution_method() {
  return {.name = "restitution",
          .source = "e = sqrt(h / H)",
          .columns = {{"drop_mm", "drop height H"}, {"rebound_mm", "rebound height h", kFromZero}},
          .outputs = {{"restitution", "", "coefficient of restitution e", restitution, 0, 1}},
          .error = drop_error,
          .validity =
              "Spin after the impact counts as loss: for a grain that is not a sphere this "
              "is not a material constant, and not the e that a simulation needs.",
          .optional_columns = {{kDiameter, "diameter of the sphere of the grain's volume"},
                               {kDensity, "density of the grain"},
                               in_air_column(),
                               uncertainty_of("drop_mm")},
          .remarks = remarks_on_air,
          .error_of_all = mixed_air_error};
}

Method sliding_method() {
  return {.name = "sliding",
          .source = "mu_s = tan(angle)",
          .columns = {{"angle_deg", "angle of the incline at which it slides", 0, kRightAngle_deg}},
          .outputs = {{"sliding_friction", "", "coefficient of static friction mu_s",
                       [](ReadingValues v) { return sliding_friction_of(v[0] * kDegree); }}},
          .error = {},
          .validity = "Holds for grains that cannot roll: bond two or three together."};
}

Method rolling_method() {
  return {.name = "rolling",
          .source = "mu_r = S sin(b) / (S cos(b) + L), with the diameter less the loss at the foot",
          .columns = {{"incline_deg", "angle b of the incline", 0, kRightAngle_deg},
                      {"released_mm", "distance S down the incline"},
                      {"stopped_mm",
                       "distance L along the flat, 0 of a grain that stayed on the incline",
                       kFromZero}},
          .outputs = {{"rolling_friction", "", "coefficient of rolling friction mu_r",
                       rolling_friction}},
          .error = roll_error,
          .validity =
              "Attributes all other losses to rolling friction, such as those by slipping and by "
              "bouncing of grains that are not round: a simulation of these needs a smaller mu_r.",
          .optional_columns = {{kDiameter,
                                "diameter of the ball, or across the axis it rolls "
                                "about"},
                               uncertainty_of("incline_deg"),
                               uncertainty_of("released_mm")},
          .remarks = remarks_on_roll};
}

/// A bed of grains has no formula; the simulation takes its place.
Method drop_on_grains_method() {
  Method method = restitution_method();
  method.name = "drop_on_grains";
  method.source = "mean of the readings";
  method.outputs = {{"rebound", "mm", "height of rebound from glued grains",
                     [](ReadingValues v) { return v[1]; }}};
  method.optional_columns = {in_air_column(), uncertainty_of("drop_mm")};
  method.remarks = {};
  method.error_of_all = {};
  method.validity =
      "No material constant: on a bed most grains are thrown aside. Calibrate a study with these "
      "readings.";
  return method;
}

Method pendulum_method() {
  return {
      .name = "pendulum",
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

}  // namespace repose::calibrate
