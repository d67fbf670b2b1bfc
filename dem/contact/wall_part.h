#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "dem/contact/material.h"

namespace repose::dem {

/// Parts of a bench that may be of another material than its plate.
enum class WallPart {
  tube,     ///< of a heap, of a fill
  incline,  ///< of a roll, down to the plate
  pane      ///< the upright walls of a draw-down's boxes
};

/// What files call them: [wall.tube], [contact.particle_tube].
inline constexpr std::array<std::pair<WallPart, std::string_view>, 3> kWallParts = {
    {{WallPart::tube, "tube"}, {WallPart::incline, "incline"}, {WallPart::pane, "pane"}}};

inline std::string name_of(WallPart part) {
  return std::string(kWallParts[static_cast<std::size_t>(part)].second);
}

/// What such a part is made of, and what it does to grains.
struct WallSurface {
  Material material;
  PairCoefficients with_grain;
};

/// The parts whose material is not that of the plate.
using WallSurfaces = std::map<WallPart, WallSurface>;

}  // namespace repose::dem
