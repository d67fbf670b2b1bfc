#pragma once

#include <algorithm>
#include <stdexcept>

namespace repose::dem {

/// A run that must not be reported as a result: what went wrong, where and when.
class UnstableRun : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Tracks how deep a run's contacts get. It sees every step, as an impact is over long before the
/// next audit. Overlaps are fractions of the smaller sphere's radius.
class OverlapWatch {
 public:
  /// Hertz's law holds for small strains: no impact of a valid run is as deep as this ...
  static constexpr double kDeepest = .3;
  /// ... and nothing at rest sinks as deep as this into its support.
  static constexpr double kDeepestAtRest = .2;

  /// @param deepest  overlap of this step
  /// @return whether it is so much deeper than before that the run must be audited now
  bool see(double deepest) {
    lasting_ = std::min(lasting_, deepest);
    if (deepest <= next_look_) return false;
    // The frequency of a contact grows with the fourth root of the overlap.
    next_look_ = std::min(2 * deepest, kDeepest);
    return true;
  }

  /// The smallest of all steps since the last call; 0 at the first call, as the steps may be few.
  double take_lasting() {
    const double lasting = has_begun_ ? lasting_ : 0;
    lasting_ = 1;
    has_begun_ = true;
    return lasting;
  }

 private:
  bool has_begun_ = false;
  double lasting_ = 1;
  double next_look_ = 0;
};

}  // namespace repose::dem
