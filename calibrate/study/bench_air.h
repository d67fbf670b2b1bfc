#pragma once

#include "dem/shape/clump/clump_shape.h"
#include "dem/study/study.h"

namespace repose::base {
struct FallingGrain;
}

/// Grains are dropped in air, and simulated without it.
namespace repose::calibrate {

/// Name of the part of a height's uncertainty that the correction for the drag of the air brings.
inline constexpr const char* kAirPart = "air_drag";

/// A grain as the air meets it: the sphericity is that of the ellipsoid with the same moments of
/// inertia, whose half-axes are a^2 = 5/2 (k_y^2 + k_z^2 - k_x^2), k^2 the moments by the mass, and
/// whose surface is 4 pi ((a^p b^p + a^p c^p + b^p c^p) / 3)^(1/p), p = 1.6075, within 1.1 %
/// (K. Thomsen, see Michon 2004, "Surface area of an ellipsoid", numericana.com).
base::FallingGrain falling_grain(const dem::ClumpShape& grain, double density_kg_m3);

/// The study with the rebounds of its drops as high as they would be without air: what was read at
/// the bench is raised by what the drag of the air takes (base::rise_without_air_m), its
/// uncertainty and what was done are in Measured::systematic. Not those that are free of it
/// already (Measured::in_air).
/// @throws base::InputError  a rebound that no such grain could have in air.
dem::Study without_air(dem::Study study, const dem::ClumpShape& grain);

}  // namespace repose::calibrate
