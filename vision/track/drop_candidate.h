#pragma once

#include <optional>
#include <vector>

#include "vision/track/drop_track.h"
#include "vision/track/film_grains.h"
#include "vision/track/flight_fit.h"

namespace repose::vision {

/// A path that may belong to a dropped grain, with its flights.
struct DropCandidate {
  const GrainPath* path = nullptr;
  std::vector<SeenAt> seen;  ///< coordinates along gravity and across it
  Estimate roll_rad = {};    ///< of gravity, from the frame's vertical
  double used_lean_rad = 0;  ///< 0 unless gravity is clearly tilted
  Flights flights = {};
  std::optional<FlightFit> fit = {};
  std::vector<std::size_t> impacts = {};  ///< indices of the flights that end with an impact

  int flown() const { return fit ? fit->sightings() : 0; }
};

/// Identifies and fits the flights of a path.
DropCandidate drop_candidate(const GrainPath& path, const FilmGrains& film);

/// Converts coordinates along and across gravity back to the picture.
cv::Point2d upright(double x_px, double y_px, double roll_rad);

/// The numbers of the bounces that were read, counted from the grain's release, or from the first
/// visible flight if the video begins with it.
struct BounceNumbers {
  std::vector<int> of_impacts;       ///< of each of the candidate's impacts, from 1
  std::vector<UnreadBounce> unread;  ///< before the last of those that were read
};

/// Bounces between two flights of which no impact was read are counted by the time between them:
/// from the landing speed v to the next flight's initial speed w, n impacts, each with restitution
/// e = (w/v)^(1/n), leave flights of 2 v e^i / g, i = 1 to n - 1 (free flight, Newton's law of
/// impact). Checked by BounceNumbers.* in tests/vision/bounce_numbers_test.cpp.
int impacts_between(double landing_px_s, double start_px_s, double gap_s, double gravity_px_s2);

BounceNumbers number_bounces(const DropCandidate& grain, const FilmGrains& film);

}  // namespace repose::vision
