#pragma once

#include "render/scene/scene.h"

namespace repose::render {

/// What was between two states of a run.
///
/// Grains go along the cubic that has their places and velocities in both (Hermite; Bartels, Beatty
/// & Barsky 1987, An introduction to splines, ch. 3), which a free flight follows exactly, and turn
/// evenly from one pose to the other; walls do both evenly. Proved by Between.* in
/// tests/render/filmed_run_test.cpp.
/// @param part  of the time from `a` to `b`, 0 to 1
/// @param interval_s  that time
/// @returns `a` where grains or walls are there that are not in the other
Scene between(const Scene& a, const Scene& b, double part, double interval_s);

}  // namespace repose::render
