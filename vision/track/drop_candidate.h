#pragma once

#include <optional>
#include <vector>

#include "vision/track/film_grains.h"
#include "vision/track/flight_fit.h"

namespace repose::vision {

/// A path that may be that of a dropped grain, with its flights.
struct DropCandidate {
  const GrainPath* path = nullptr;
  std::vector<SeenAt> seen;  ///< along gravity and across it
  Estimate lean_rad = {};    ///< of gravity against the frame's upright
  double used_lean_rad = 0;  ///< 0 where gravity is not known to lean
  Flights flights = {};
  std::optional<FlightFit> fit = {};
  std::vector<std::size_t> impacts = {};  ///< numbers of the flights that end with one

  int flown() const { return fit ? fit->sightings() : 0; }
};

/// Finds and fits the flights of a path.
DropCandidate drop_candidate(const GrainPath& path, const FilmGrains& film);

/// A place that is given along gravity and across it, in the picture again.
cv::Point2d upright(double x_px, double y_px, double lean_rad);

}  // namespace repose::vision
