#pragma once

#include <string>

namespace repose::bench {

/// Simulates drops, rolls or tilts with many settings, films them with the renderer, tracks the
/// films and prints how close the readings come to the simulations' values.
/// @param experiment  drop, roll or tilt
/// @param prints_each  prints a line for each film when it is done
void print_rendered_accuracy(const std::string& experiment, double frames_per_s, int films,
                             unsigned first_seed, bool prints_each);

}  // namespace repose::bench
