#pragma once

#include <vector>

#include "dem/verify/trial.h"

namespace repose::dem {

/// Central impacts: Chung & Ooi T1-T3, restitution, bounce heights.
std::vector<VerifyCase> impact_cases();
/// Impacts of clumps on several spheres at once.
std::vector<VerifyCase> clump_cases();
/// Impacts with sliding: Chung & Ooi T4-T8.
std::vector<VerifyCase> oblique_cases();
/// Impacts measured by Kharaz et al.
std::vector<VerifyCase> kharaz_cases();
/// Sliding, and rolling without resistance.
std::vector<VerifyCase> motion_cases();
/// The three models of rolling resistance.
std::vector<VerifyCase> rolling_cases();
/// Free rotation.
std::vector<VerifyCase> rotation_cases();
/// Beds of fixed spheres.
std::vector<VerifyCase> bed_cases();
/// Energy and momentum of collisions.
std::vector<VerifyCase> conservation_cases();

}  // namespace repose::dem
