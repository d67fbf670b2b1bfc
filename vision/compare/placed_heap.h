#pragma once

#include <array>
#include <optional>

#include "vision/compare/skyline.h"
#include "vision/measure/flank.h"

namespace repose::vision {

/// A measured heap on level ground [px of its picture], not yet aligned with another one.
struct StandingHeap {
  Skyline skyline;
  double height = 0;
  double crest = 0;            ///< along the ground
  std::optional<double> axis;  ///< likewise; empty unless both flanks are there
  Segment ground;

  /// Point of the picture that lies there on the ground [px].
  Point on_ground(double along) const;
};

/// Needs a result that is not refused.
StandingHeap standing_heap(const ReposeAngle& measured);

/// How far the two heaps, aligned and in one unit, can be compared.
struct Reach {
  std::array<Cover, 2> cover = {Cover::none, Cover::none};  ///< left, right
  /// Whether the picture's edge cuts off that side: [heap][left, right].
  std::array<std::array<bool, 2>, 2> is_cut = {};

  /// The stretch left (ends at 0) or right (begins at 0) of the axis; empty where cover is none.
  std::array<double, 2> stretch(const Skyline& a, const Skyline& b, Side side) const;
};

Reach reach_of(const ReposeAngle& first, const ReposeAngle& second);

}  // namespace repose::vision
