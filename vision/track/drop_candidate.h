#pragma once

#include <optional>
#include <vector>

#include "vision/track/drop_track.h"
#include "vision/track/film_grains.h"
#include "vision/track/flight_fit.h"

namespace repose::vision {

/// A path that may be that of a dropped grain, with its flights.
struct DropCandidate {
  const GrainPath* path = nullptr;
  std::vector<SeenAt> seen;  ///< along gravity and across it
  Estimate roll_rad = {};    ///< of gravity against the frame's upright
  double used_lean_rad = 0;  ///< 0 where gravity is not known to lean
  Flights flights = {};
  std::optional<FlightFit> fit = {};
  std::vector<std::size_t> impacts = {};  ///< numbers of the flights that end with one

  int flown() const { return fit ? fit->sightings() : 0; }
};

/// Finds and fits the flights of a path.
DropCandidate drop_candidate(const GrainPath& path, const FilmGrains& film);

/// A place that is given along gravity and across it, in the picture again.
cv::Point2d upright(double x_px, double y_px, double roll_rad);

/// Which bounces of the grain those are that were read, counted from its release, or from the first
/// flight that is seen where the film begins with it.
struct BounceNumbers {
  std::vector<int> of_impacts;       ///< of each of the candidate's, from 1 on
  std::vector<UnreadBounce> unread;  ///< before the last of these
};

/// Bounces between two flights, of which no impact was read, are counted by the time between them:
/// from the speed v of the one landing to the speed w of the other's start, n impacts that restore
/// e = (w/v)^(1/n) each leave flights of 2 v e^i / g, i = 1 to n - 1 (free flight, Newton's law of
/// impact). Checked by BounceNumbers.* in tests/vision/bounce_numbers_test.cpp.
int impacts_between(double landing_px_s, double start_px_s, double gap_s, double gravity_px_s2);

BounceNumbers number_bounces(const DropCandidate& grain, const FilmGrains& film);

}  // namespace repose::vision
