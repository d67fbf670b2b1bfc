#pragma once

#include "dem/engine/simulation.h"

namespace repose::dem {

/// A grain that flies for a time and touches nothing: its centre on a parabola, its orientation by
/// its angular momentum, which stays (Runge and Kutta's method of fourth order in steps of a tenth
/// of a radian at most). Proved by FreeFlight.* in tests/dem/free_flight_test.cpp.
Grain after_flight(const Grain& grain, const ClumpShape& shape, const Vector& gravity_m_s2,
                   double time_s);

}  // namespace repose::dem
