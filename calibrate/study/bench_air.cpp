#include "calibrate/study/bench_air.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/air_drag.h"
#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/statistics/summary.h"
#include "dem/study/experiment_table.h"

namespace repose::calibrate {
namespace {

/// None: nothing falls in it.
std::optional<double> fall_m(const dem::Protocol& protocol) {
  if (const auto* drop = std::get_if<dem::DropProtocol>(&protocol)) return drop->height_m;
  if (const auto* drop = std::get_if<dem::GrainDropProtocol>(&protocol)) return drop->height_m;
  return std::nullopt;
}

/// Takes the air out of one experiment's heights, which are in mm.
class Evacuation {
 public:
  Evacuation(std::string experiment, const base::FallingGrain& grain, double fall_m)
      : experiment_(std::move(experiment)), grain_(grain), fall_m_(fall_m) {}

  /// Heights below 0, of grains that topple, are no flights.
  double rise_mm(double read_mm) const {
    if (read_mm <= 0) return read_mm;
    return kMmPerM * base::rise_without_air_m(grain_, fall_m_, read_mm * kMPerMm);
  }

  void check(double read_mm) {
    errors_.require(
        rise_mm(read_mm) <= kMmPerM * fall_m_,
        {.value = fmt::format("[experiment.{}]: a rebound of {:g} mm after a fall of {:g} mm",
                              experiment_, read_mm, kMmPerM * fall_m_),
         .rule = fmt::format("no higher than the grain, of {:.3g} mm and {:g} kg/m3, fell, less "
                             "what the drag of the air takes",
                             kMmPerM * grain_.diameter_m, grain_.density_kg_m3),
         .fix = "check the grain's size and density; in_air = false beside readings that are free "
                "of drag already."});
  }

  /// How much the rise changes with what is read.
  double slope(double read_mm) const {
    constexpr double kStep = 1e-3;
    if (read_mm <= 0) return 1;
    return (rise_mm(read_mm) - rise_mm((1 - kStep) * read_mm)) / (kStep * read_mm);
  }

  dem::Systematic systematic(double read_mm) const {
    const double rise = rise_mm(read_mm);
    const double sd = base::drag_uncertainty(grain_) * std::abs(rise - read_mm);
    return {.name = kAirPart,
            .sd = sd,
            .note = fmt::format(
                "the drag of the air is taken out: {:.4g} mm read in air count as {:.4g} mm, ± "
                "{:.2g} mm (standard uncertainty), as of a grain of {:.3g} mm, {:g} kg/m3 and "
                "sphericity {:.2f}. Where readings are free of drag already, say in_air = false",
                read_mm, rise, sd, kMmPerM * grain_.diameter_m, grain_.density_kg_m3,
                grain_.sphericity)};
  }

  /// What was known of the heights as they were read goes with the slope, as their scatter does.
  void add_to(std::vector<dem::Systematic>& parts, double read_mm) const {
    for (dem::Systematic& part : parts) part.sd *= slope(read_mm);
    parts.push_back(systematic(read_mm));
  }

  void take_out(dem::Measured& measured) {
    if (measured.mean) {
      check(*measured.mean);
      add_to(measured.systematic, *measured.mean);
      if (measured.sd) *measured.sd *= slope(*measured.mean);
      *measured.mean = rise_mm(*measured.mean);
    } else if (!measured.values.empty()) {
      add_to(measured.systematic, summarise(measured.values).mean);
      for (double& value : measured.values) {
        check(value);
        value = rise_mm(value);
      }
    }
    for (dem::MeasuredReading& reading : measured.also) {
      check(reading.mean);
      add_to(reading.systematic, reading.mean);
      if (reading.sd) *reading.sd *= slope(reading.mean);
      reading.mean = rise_mm(reading.mean);
    }
  }

  void throw_if_impossible() const { errors_.throw_if_any(); }

 private:
  std::string experiment_;
  base::FallingGrain grain_;
  double fall_m_;
  base::Faults errors_;
};

}  // namespace

base::FallingGrain falling_grain(const dem::ClumpShape& grain, double density_kg_m3) {
  constexpr double kFlattest = 1e-3;  // of the largest: what is thinner has no sphericity
  const dem::Vector& k2 = grain.gyration_m2;
  std::array<double, 3> axes{};
  for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(i)] = 2.5 * (k2.sum() - 2 * k2[i]);
  const double longest2 = *std::max_element(axes.begin(), axes.end());
  for (double& axis : axes) axis = std::sqrt(std::max(axis, kFlattest * kFlattest * longest2));
  constexpr double kPower = 1.6075;
  const auto part = [&](std::size_t i, std::size_t j) {
    return std::pow(axes[i] * axes[j], kPower) / 3;
  };
  const double surface = std::pow(part(0, 1) + part(0, 2) + part(1, 2), 1 / kPower);
  const double sphere = std::pow(axes[0] * axes[1] * axes[2], 2. / 3);
  return {.diameter_m = std::cbrt(6 / std::numbers::pi * grain.volume_m3),
          .density_kg_m3 = density_kg_m3,
          .sphericity = std::min(1., sphere / surface)};
}

dem::Study without_air(dem::Study study, const dem::ClumpShape& grain) {
  const base::FallingGrain falling = falling_grain(grain, study.model.grain_material.density_kg_m3);
  for (auto& [experiment, described] : study.experiments) {
    const auto height_m = fall_m(described.protocol);
    if (!height_m || !described.measured.in_air) continue;
    Evacuation evacuation(dem::name_of(experiment), falling, *height_m);
    evacuation.take_out(described.measured);
    evacuation.throw_if_impossible();
  }
  return study;
}

}  // namespace repose::calibrate
