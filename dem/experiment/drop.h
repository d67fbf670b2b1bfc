#pragma once

#include <cstdint>
#include <optional>

#include "dem/engine/simulation.h"
#include "dem/experiment/experiment.h"

namespace repose::dem {

/// Single grains dropped on a flat wall in random poses.
///
/// Value: rise of the centroid from its lowest point during the bounce to the top of the first
/// flight after it, mm, mean over the grains; 0 for a grain that never leaves the wall. This is
/// what a camera sees. Readings: "above_first_touch_mm" (the same from the height of the centroid
/// at first touch: smaller, negative for a grain that topples), "lowest_point_rise_mm" (height of
/// the lowest surface point above the wall at the top), "sd_mm" (scatter of the value between
/// grains), "never_rose" (number of grains), and with a lower height "low_rebound_mm" (the value
/// from there, for the same grains in the same poses).
struct DropProtocol {
  double height_m = .5;  ///< of the lowest point above the wall
  int grains = 10;       ///< in random poses, each on its own: one repeat is their mean
  /// A second drop, from below `height_m`: tests whether one restitution fits both speeds.
  std::optional<double> low_height_m = {};
};

Repeat run_drop(const Model& model, const DropProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});

/// Single grains dropped on a plate covered with glued grains of their kind (glued_bed.h),
/// otherwise as in DropProtocol: same value, same readings, but no second height.
struct GrainDropProtocol {
  double height_m = .2;  ///< of the lowest point above the highest glued grain
  int grains = 20;       ///< in random poses over random places, each on its own
  double coverage = .75;
};

Repeat run_drop_on_grains(const Model& model, const GrainDropProtocol& protocol, std::uint64_t seed,
                          const ProgressReport& report = {}, const RunRecord& record = {});

/// A grain after free flight: its centre follows a parabola, its orientation the conserved angular
/// momentum (fourth-order Runge-Kutta in steps of at most a tenth of a radian). Proved by
/// FreeFlight.* in tests/dem/free_flight_test.cpp.
Grain after_flight(const Grain& grain, const ClumpShape& shape, const Vector& gravity_m_s2,
                   double time_s);

}  // namespace repose::dem
