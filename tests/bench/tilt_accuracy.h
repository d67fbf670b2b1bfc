#pragma once

namespace repose::bench {

/// Draws films of tilts with many settings, tracks them and prints how close the angles come.
/// @param prints_each  prints a line for each film when it is done
void print_tilt_accuracy(double frames_per_s, int films, unsigned first_seed, bool prints_each);

}  // namespace repose::bench
