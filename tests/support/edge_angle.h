#pragma once

#include <span>

namespace repose::testing {

/// A point of a heap's edge on one side: `out` from the crest, `height` above the ground.
struct EdgePoint {
  double out = 0;
  double height = 0;
};

/// The part of the edge between 20 and 80 % of a heap's height.
struct EdgeAngle {
  EdgePoint high;        ///< where the edge falls below 80 %
  EdgePoint low;         ///< where it falls below 20 %
  double angle_rad = 0;  ///< of the least-squares line of height on `out`, over every column
  double bend_rad = 0;   ///< angle of the inner half of the columns less that of the outer half
};

/// The angle by its definition, independent of the measuring code. Points from the crest outwards.
/// If the edge is bumpy, `smooth` determines where the window ends: points of the same edge without
/// its bumps; empty if it has none.
/// @throws std::invalid_argument  the edge does not fall from above 80 % to below 20 %.
EdgeAngle angle_of_edge(std::span<const EdgePoint> edge, double heap_height,
                        std::span<const EdgePoint> smooth = {});

}  // namespace repose::testing
