#pragma once

#include <string>

namespace repose::calibrate::test {

/// A soft ball and a stiffer wall: a run takes a few hundredths of a second.
inline const std::string kSoftBall = R"([particle]
size_mm = [20, 20, 20]
spheres = 1
density_kg_m3 = 1000
young_modulus_pa = 1e6
poisson_ratio = 0.3
[wall]
young_modulus_pa = 1e8
poisson_ratio = 0.3
)";

/// A drop determines its restitution, a tilting plate its friction.
inline const std::string kSphereStudy = kSoftBall + R"([contact.particle_wall]
restitution = { min = 0.2, max = 0.9 }
sliding_friction = { min = 0.1, max = 0.8 }
rolling_friction = 0.01
[contact.particle_particle]
restitution = 0.2
sliding_friction = 0.2
rolling_friction = 0.04
[experiment.drop]
height_mm = 100
grains = 1
measured = { mean = 25, sd = 1, n = 5 }
[experiment.tilt]
rate_deg_s = 10
measured = { values = [20.1, 21.3, 20.7, 19.8] }
)";

}  // namespace repose::calibrate::test
