#pragma once

#include "dem/verify/scene.h"

namespace repose::dem {

// The impacts of Kharaz, Gorham and Salman (2001), Powder Technology 120, which Chung & Ooi (2011)
// used for their T4: an Al2O3 ball of 5 mm on glass.
inline constexpr double kKharazRadius_m = .0025;
inline constexpr double kKharazSpeed_m_s = 3.9;
inline constexpr double kKharazRestitution = .98;
inline constexpr double kKharazFriction = .092;

struct ObliqueRebound {
  double tangential_restitution = 0;  ///< of the centre: speed after over speed before
  double angle_deg = 0;               ///< of the rebound, from the normal
  double spin_rad_s = 0;
};

/// An impact at an angle from the normal.
ObliqueRebound kharaz_impact(Trial& trial, double angle_deg);

}  // namespace repose::dem
