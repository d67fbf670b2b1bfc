#pragma once

/// Grains of one run that must never meet.
namespace repose::dem {

/// From one to the next of grains that fall from a height and rebound.
inline double drop_spacing_m(double height_m, double reach_m) { return 8 * (height_m + reach_m); }

/// From one to the next of bodies that slide down a plate, side by side.
inline double lane_m(double body_reach_m) { return 20 * body_reach_m; }

}  // namespace repose::dem
