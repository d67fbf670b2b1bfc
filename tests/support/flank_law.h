#pragma once

#include "tests/support/heap_scene.h"

namespace repose::testing {

/// How a flank falls from the apex (out = 0) to the toe (out = 1). Heights / height of the apex.
class FlankLaw {
 public:
  /// `hollow` is the exponent p of (1 - out)^p, or the decay k of exp(-k out) less its value at the
  /// toe, scaled to 1 at the apex. A straight flank is p = 1.
  FlankLaw(Flanks flanks, double hollow);

  double height(double out) const;
  double out_at(double height) const;     ///< inverse of height()
  double steepness(double height) const;  ///< loss of height per `out` at that height

 private:
  bool is_power_;
  double hollow_;
};

/// The p or k that makes the window's upper half steeper than its lower half by `bend_rad` if the
/// line from toe to apex has slope `chord_slope`.
double hollow_of_bend(Flanks flanks, double chord_slope, double bend_rad);

}  // namespace repose::testing
