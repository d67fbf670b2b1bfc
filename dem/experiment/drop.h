#pragma once

#include <cstdint>
#include <optional>

#include "dem/engine/simulation.h"
#include "dem/experiment/experiment.h"

namespace repose::dem {

/// Single grains dropped on a flat wall in random poses.
///
/// Value: how far the centroid rises from its lowest place during the bounce to the top of the
/// first flight after it, mm, mean of the grains; 0 for a grain that never leaves the wall. It is
/// what a camera sees. Readings: "above_first_touch_mm" (the same from the height of the centroid
/// at first touch: less, below 0 for a grain that topples), "lowest_point_rise_mm" (of the lowest
/// surface point over the wall at the top), "sd_mm" (scatter of the value between grains),
/// "never_rose" (how many), and with a lower height "low_rebound_mm" (the value from there, of the
/// same grains in the same poses).
struct DropProtocol {
  double height_m = .5;  ///< of the lowest point above the wall
  int grains = 10;       ///< in random poses, each on its own: one repeat is their mean
  /// A second drop, from below `height_m`: whether one restitution stands for both speeds.
  std::optional<double> low_height_m = {};
};

Repeat run_drop(const Model& model, const DropProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});

/// Single grains dropped on a plate that is covered with glued grains of their kind (glued_bed.h),
/// else as in DropProtocol: same value, same readings.
struct GrainDropProtocol {
  double height_m = .2;  ///< of the lowest point above the highest glued grain
  int grains = 20;       ///< in random poses over random places, each on its own
  double coverage = .75;
};

Repeat run_drop_on_grains(const Model& model, const GrainDropProtocol& protocol, std::uint64_t seed,
                          const ProgressReport& report = {}, const RunRecord& record = {});

/// A grain that flies for a time and touches nothing: its centre on a parabola, its orientation by
/// its angular momentum, which stays (Runge and Kutta's method of fourth order in steps of a tenth
/// of a radian at most). Proved by FreeFlight.* in tests/dem/free_flight_test.cpp.
Grain after_flight(const Grain& grain, const ClumpShape& shape, const Vector& gravity_m_s2,
                   double time_s);

}  // namespace repose::dem
