#pragma once

#include <string>

namespace repose::calibrate {

/// A quantity set to several levels: its natural levels (in its own unit) at the coded levels -1
/// and +1.
struct Factor {
  std::string name;
  double low = -1;
  double high = 1;

  double centre() const { return (low + high) / 2; }
  double half_range() const { return (high - low) / 2; }
  double natural(double coded) const { return centre() + coded * half_range(); }
  double coded(double natural) const { return (natural - centre()) / half_range(); }
};

}  // namespace repose::calibrate
