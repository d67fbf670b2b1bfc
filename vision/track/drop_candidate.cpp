#include "vision/track/drop_candidate.h"

#include <algorithm>
#include <cmath>

#include "vision/track/parabola.h"

namespace repose::vision {
namespace {

std::vector<SeenAt> along_gravity(const GrainPath& path, const FilmGrains& film, double lean_rad) {
  std::vector<SeenAt> seen;
  for (const Sighting& one : path) {
    if (one.blob.touches_edge) continue;
    const cv::Point2d& at = one.blob.centre;
    seen.push_back({.time_s = one.time_s,
                    .x_px = at.x * std::cos(lean_rad) - at.y * std::sin(lean_rad),
                    .y_px = at.x * std::sin(lean_rad) + at.y * std::cos(lean_rad),
                    .row_px = one.blob.centre.y - .5 * film.survey.size.height});
  }
  return seen;
}

/// The direction of gravity, from the bend of the flights sideways.
Estimate lean_of(const std::vector<SeenAt>& seen, const Flights& flights) {
  std::vector<SeenAt> sideways = seen;
  for (SeenAt& one : sideways) std::swap(one.x_px, one.y_px);
  double sum = 0, weights = 0;
  for (const FlightSpan& span : flights.spans) {
    constexpr std::size_t kFewest = 5;
    if (span.to - span.from < kFewest) continue;
    const Parabola parabola = parabola_through(sideways, span.from, span.to - span.from);
    const double weight = 1 / (parabola.error * parabola.error);
    sum += weight * parabola.acceleration;
    weights += weight;
  }
  if (weights <= 0) return {};
  return {std::atan2(sum / weights, flights.gravity_px_s2),
          2 / std::sqrt(weights) / flights.gravity_px_s2};
}

/// What a parabola may be off by: centres are better, but air and lens bend long flights.
double tolerance_px(const std::vector<SeenAt>& seen) {
  constexpr double kLeast_px = .5, kOfWay = .0015;
  const auto by_height = [](const SeenAt& a, const SeenAt& b) { return a.y_px < b.y_px; };
  const auto [highest, lowest] = std::minmax_element(seen.begin(), seen.end(), by_height);
  return seen.empty() ? kLeast_px : std::max(kLeast_px, kOfWay * (lowest->y_px - highest->y_px));
}

/// Whether a flight goes on in the next one as if it were one: nothing strikes the grain between
/// them, which would change its speed by more than gravity does in a frame.
bool goes_on(const FlightFit& fit, std::size_t k, double interval_s) {
  const FlightCurve& before = fit.curves()[k];
  const FlightCurve& after = fit.curves()[k + 1];
  constexpr double kNext = 1.5, kNear_px = 1.5;
  if (after.begins_s - before.ends_s > kNext * interval_s) return false;
  const double time_s = .5 * (before.ends_s + after.begins_s);
  const double apart_px =
      height_at(after, time_s, fit.pull()) - height_at(before, time_s, fit.pull());
  const double faster_px_s =
      speed_at(after, time_s, fit.pull()) - speed_at(before, time_s, fit.pull());
  return std::abs(apart_px) < kNear_px && std::abs(faster_px_s) < fit.pull().gravity * interval_s;
}

/// Flights that were found in two pieces, because air or the camera's readout bend them, are one.
bool join_pieces(Flights& flights, const FlightFit& fit, double interval_s) {
  std::vector<FlightSpan> joined = {flights.spans.front()};
  for (std::size_t k = 1; k < flights.spans.size(); ++k) {
    if (goes_on(fit, k - 1, interval_s)) {
      joined.back().to = flights.spans[k].to;
    } else {
      joined.push_back(flights.spans[k]);
    }
  }
  const bool has_joined = joined.size() < flights.spans.size();
  flights.spans = std::move(joined);
  return has_joined;
}

/// As wide as a disc of its area is in most frames.
double radius_px(const GrainPath& path) {
  std::vector<double> areas;
  for (const Sighting& one : path) areas.push_back(one.blob.area_px);
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  return std::sqrt(*middle / CV_PI);
}

void fit(DropCandidate& candidate, const FilmGrains& film) {
  candidate.fit.reset();
  candidate.flights = find_flights(candidate.seen, tolerance_px(candidate.seen));
  if (candidate.flights.spans.empty()) return;
  const auto fit_flights = [&] {
    candidate.fit.emplace(candidate.seen, candidate.flights, film.survey.interval_s,
                          film.survey.size.height, radius_px(*candidate.path));
  };
  fit_flights();
  if (join_pieces(candidate.flights, *candidate.fit, film.survey.interval_s)) fit_flights();
}

}  // namespace

cv::Point2d upright(double x_px, double y_px, double lean_rad) {
  return {x_px * std::cos(lean_rad) + y_px * std::sin(lean_rad),
          y_px * std::cos(lean_rad) - x_px * std::sin(lean_rad)};
}

DropCandidate drop_candidate(const GrainPath& path, const FilmGrains& film) {
  DropCandidate candidate{.path = &path, .seen = along_gravity(path, film, 0)};
  fit(candidate, film);
  if (!candidate.fit) return candidate;
  candidate.lean_rad = lean_of(candidate.seen, candidate.flights);
  constexpr double kLeast_rad = .005, kMost_rad = .35;
  const double lean = std::abs(candidate.lean_rad.value);
  if (lean > std::max(kLeast_rad, 1.5 * candidate.lean_rad.uncertainty) && lean < kMost_rad) {
    candidate.used_lean_rad = candidate.lean_rad.value;
    candidate.seen = along_gravity(path, film, candidate.used_lean_rad);
    fit(candidate, film);
    if (!candidate.fit) return candidate;
  }
  for (std::size_t k = 0; k + 1 < candidate.fit->curves().size(); ++k) {
    if (candidate.fit->has_impact_after(k)) candidate.impacts.push_back(k);
  }
  return candidate;
}

}  // namespace repose::vision
