#pragma once

#include <string>

namespace repose::testing {

/// Soft material for the grains, and a wall.
inline const std::string kSoftMatter = R"(
density_kg_m3 = 850
young_modulus_pa = 1e6
poisson_ratio = 0.38
[wall]
young_modulus_pa = 1e9
poisson_ratio = 0.3
)";

/// Grains of two spheres: runs take a fraction of a second, heaps a few seconds.
inline const std::string kSoftNuts = R"([particle]
size_mm = [22.5, 18.2, 17.5]
spheres = 2)" + kSoftMatter;

/// Balls, which need no sphere fit.
inline const std::string kSoftBalls = R"([particle]
size_mm = [18, 18, 18]
spheres = 1)" + kSoftMatter;

/// Rough enough for a few grains to form a heap that can be measured in pictures.
inline const std::string kRoughContacts = R"([contact.particle_wall]
restitution = 0.3
sliding_friction = 0.8
rolling_friction = 0.3
[contact.particle_particle]
restitution = 0.2
sliding_friction = 0.5
rolling_friction = 0.1
)";

}  // namespace repose::testing
