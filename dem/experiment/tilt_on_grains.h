#pragma once

#include <cstdint>

#include "dem/experiment/experiment.h"

namespace repose::dem {

/// Grains bonded side by side, as in TiltProtocol, on a plate covered with glued grains of the same
/// kind (glued_bed.h): only grains touch each other.
///
/// They are put down at random places on a random bed, settle into its hollows, and the plate turns
/// from level. Value: the plate's angle when they last stood still before sliding by a grain's
/// diameter, degrees, mean over the places: shifts within a hollow do not count. It includes
/// interlocking, so it is above the angle of friction. Readings: "first_shift_deg" (mean angle at a
/// shift of a tenth of a diameter) and "sd_deg" (scatter of the value between places). Throws
/// NoMeasurement for grains that hold up to 89 degrees.
struct GrainTiltProtocol {
  int bonded = 3;
  double rate_deg_s = 5;
  int places = 10;        ///< each with its own grains; one repeat is their mean
  double coverage = .75;  ///< fraction of the plate hidden by the glued grains
};

Repeat run_tilt_on_grains(const Model& model, const GrainTiltProtocol& protocol, std::uint64_t seed,
                          const ProgressReport& report = {}, const RunRecord& record = {});

/// The same with single grains, which roll out of their hollows.
struct GrainRollProtocol {
  double rate_deg_s = 5;
  int places = 10;
  double coverage = .75;
};

Repeat run_roll_on_grains(const Model& model, const GrainRollProtocol& protocol, std::uint64_t seed,
                          const ProgressReport& report = {}, const RunRecord& record = {});

}  // namespace repose::dem
