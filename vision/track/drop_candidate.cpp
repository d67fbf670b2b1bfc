#include "vision/track/drop_candidate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "vision/track/flight_fit.h"

namespace repose::vision {

namespace {

std::vector<SeenAt> along_gravity(const GrainPath& path, const FilmGrains& film, double roll_rad) {
  std::vector<SeenAt> seen;
  for (const Sighting& one : path) {
    if (one.blob.touches_edge) continue;
    const cv::Point2d& at = one.blob.centre;
    seen.push_back({.time_s = one.time_s,
                    .x_px = at.x * std::cos(roll_rad) - at.y * std::sin(roll_rad),
                    .y_px = at.x * std::sin(roll_rad) + at.y * std::cos(roll_rad),
                    .row_px = one.blob.centre.y - .5 * film.survey.size.height});
  }
  return seen;
}

/// The direction of gravity, from the sideways curvature of the flights.
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

/// Deviation allowed from a parabola: centres are more accurate, but air and lens bend long
/// flights.
double tolerance_px(const std::vector<SeenAt>& seen) {
  constexpr double kMin_px = .5, kOfWay = .0015;
  const auto by_height = [](const SeenAt& a, const SeenAt& b) { return a.y_px < b.y_px; };
  const auto [highest, lowest] = std::minmax_element(seen.begin(), seen.end(), by_height);
  return seen.empty() ? kMin_px : std::max(kMin_px, kOfWay * (lowest->y_px - highest->y_px));
}

/// Whether two flights are one: no impact between them, which would change the speed by more than
/// gravity does in a frame.
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

/// Joins flights that were found in two pieces because of air drag or the camera's readout.
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

/// Radius of a disc with the median area.
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

cv::Point2d upright(double x_px, double y_px, double roll_rad) {
  return {x_px * std::cos(roll_rad) + y_px * std::sin(roll_rad),
          y_px * std::cos(roll_rad) - x_px * std::sin(roll_rad)};
}

DropCandidate drop_candidate(const GrainPath& path, const FilmGrains& film) {
  DropCandidate candidate{.path = &path, .seen = along_gravity(path, film, 0)};
  fit(candidate, film);
  if (!candidate.fit) return candidate;
  candidate.roll_rad = lean_of(candidate.seen, candidate.flights);
  constexpr double kMin_rad = .005, kMax_rad = .35;
  const double lean = std::abs(candidate.roll_rad.value);
  if (lean > std::max(kMin_rad, 1.5 * candidate.roll_rad.uncertainty) && lean < kMax_rad) {
    candidate.used_lean_rad = candidate.roll_rad.value;
    candidate.seen = along_gravity(path, film, candidate.used_lean_rad);
    fit(candidate, film);
    if (!candidate.fit) return candidate;
  }
  for (std::size_t k = 0; k + 1 < candidate.fit->curves().size(); ++k) {
    if (candidate.fit->has_impact_after(k)) candidate.impacts.push_back(k);
  }
  return candidate;
}

namespace {

/// When a flight would leave the floor and land on it with nothing else in its way.
struct FloorTimes {
  double start_s = 0;
  double landing_s = 0;
};

/// Without air drag, which is small. std::nullopt if the flight stays below the floor's level.
std::optional<FloorTimes> floor_times(const FlightCurve& curve, const FlightDynamics& pull,
                                      double floor_px) {
  const double top = top_s(curve, pull);
  const double height_px = floor_px - height_at(curve, top, pull);
  if (height_px <= 0) return std::nullopt;
  const double half_s = std::sqrt(2 * height_px / pull.gravity);
  return FloorTimes{top - half_s, top + half_s};
}

/// Height of the grain's centre at an impact.
double floor_px(const DropCandidate& grain) {
  const std::size_t k = grain.impacts.front();
  return height_at(grain.fit->curves()[k], grain.fit->impact_time_s(k), grain.fit->pull());
}

/// Two pieces of one flight, with the grain unseen between them.
bool is_same_flight(const FloorTimes& one, const FloorTimes& next) {
  constexpr double kPart = .25;
  return std::abs(next.landing_s - one.landing_s) < kPart * (one.landing_s - one.start_s);
}

/// Number of impacts between flights k and k + 1; adds those that were not read, with their times.
int impacts_after(const DropCandidate& grain, std::size_t k, double floor, int number,
                  std::vector<UnreadBounce>& unread) {
  const FlightFit& fit = *grain.fit;
  if (fit.has_impact_after(k)) return 1;
  const auto here = floor_times(fit.curves()[k], fit.pull(), floor);
  const auto next = floor_times(fit.curves()[k + 1], fit.pull(), floor);
  if (!here || !next) {
    unread.push_back({.number = number});
    return 1;
  }
  if (is_same_flight(*here, *next)) return 0;
  const double gravity = fit.pull().gravity;
  const double landing = .5 * gravity * (here->landing_s - here->start_s);
  const double start = .5 * gravity * (next->landing_s - next->start_s);
  const int count = impacts_between(landing, start, next->start_s - here->landing_s, gravity);
  double time_s = here->landing_s;
  for (int n = 0; n < count; ++n) {
    unread.push_back({.number = number + n, .time_s = time_s});
    time_s += 2 * landing * std::pow(start / landing, (n + 1.) / count) / gravity;
  }
  return count;
}

/// Whether two blobs may be the same thing: of similar size and colour.
bool is_alike(const Blob& one, const Blob& other) {
  constexpr double kArea = 2, kColours = 90;
  return one.area_px < kArea * other.area_px && other.area_px < kArea * one.area_px &&
         cv::norm(one.colour - other.colour) < kColours;
}

/// Coordinate along gravity, downwards.
double along_px(const DropCandidate& grain, const Blob& blob) {
  return blob.centre.x * std::sin(grain.used_lean_rad) +
         blob.centre.y * std::cos(grain.used_lean_rad);
}

/// Sightings of what may be the grain before a given time, in order.
std::vector<Sighting> seen_before(const DropCandidate& grain, const FilmGrains& film,
                                  double time_s) {
  const Blob& looks = (*grain.path)[grain.path->size() / 2].blob;
  std::vector<Sighting> seen;
  for (const GrainPath& path : film.paths) {
    // Anything seen at the same time as the grain is something else.
    const bool is_own = &path == grain.path;
    if (!is_own && path.back().time_s >= grain.path->front().time_s) continue;
    for (const Sighting& one : path) {
      if (one.time_s < time_s && is_alike(one.blob, looks)) seen.push_back(one);
    }
  }
  std::stable_sort(seen.begin(), seen.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return seen;
}

/// Whether the grain was held just before: it hardly moves between the last sightings.
bool is_held(const std::vector<Sighting>& seen, double until_s, double interval_s) {
  constexpr double kFrames = 4, kHeld_px = 1;
  const auto count = seen.size();
  if (count < 2 || until_s - seen[count - 2].time_s > kFrames * interval_s) return false;
  return cv::norm(seen[count - 1].blob.centre - seen[count - 2].blob.centre) < kHeld_px;
}

/// Whether frames are missing just before, for longer than an impact hides the grain.
bool follows_gap(const FilmGrains& film, double time_s) {
  constexpr double kLong = 5, kNear = 1.5;
  const std::vector<double>& times = film.survey.times_s;
  const double interval_s = film.survey.interval_s;
  for (std::size_t k = 1; k < times.size() && times[k - 1] <= time_s; ++k) {
    const bool is_near = times[k] > time_s - kNear * interval_s;
    if (is_near && times[k] - times[k - 1] > kLong * interval_s) return true;
  }
  return false;
}

/// Whether the first fitted flight cannot be the first the grain made.
bool is_later_flight(const DropCandidate& grain, const FilmGrains& film, double floor) {
  const FlightFit& fit = *grain.fit;
  const FlightCurve& first = fit.curves().front();
  const double interval_s = film.survey.interval_s;
  const double top = top_s(first, fit.pull());
  const double top_px = height_at(first, top, fit.pull());
  const double fall_px = floor - top_px;
  constexpr double kFrames = 1.5, kRise = .04, kMinRise_px = 3, kHigher = .06, kMin_px = 6;
  const double risen_px = height_at(first, first.begins_s, fit.pull()) - top_px;
  if (top > first.begins_s + kFrames * interval_s &&
      risen_px > std::max(kMinRise_px, kRise * fall_px)) {
    return true;  // it rises: after an impact, or thrown
  }
  const std::vector<Sighting> before = seen_before(grain, film, first.begins_s);
  if (is_held(before, first.begins_s, interval_s)) return false;
  for (const Sighting& one : before) {
    const double higher_px = top_px - along_px(grain, one.blob);
    if (higher_px > std::max(kMin_px, kHigher * fall_px)) return true;
  }
  const double fallen_s = first.begins_s - top;
  return fallen_s > kFrames * interval_s && follows_gap(film, first.begins_s);
}

}  // namespace

int impacts_between(double landing_px_s, double start_px_s, double gap_s, double gravity_px_s2) {
  constexpr int kMax = 12;
  const double kept = start_px_s / landing_px_s;
  if (kept <= 0 || kept >= 1) return 1;
  int best = 1;
  double least_s = std::abs(gap_s);
  for (int count = 2; count <= kMax; ++count) {
    const double each = std::pow(kept, 1. / count);
    double flown_s = 0;
    for (int n = 1; n < count; ++n) {
      flown_s += 2 * landing_px_s * std::pow(each, n) / gravity_px_s2;
    }
    if (std::abs(flown_s - gap_s) >= least_s) continue;
    least_s = std::abs(flown_s - gap_s);
    best = count;
  }
  return best;
}

BounceNumbers number_bounces(const DropCandidate& grain, const FilmGrains& film) {
  BounceNumbers numbers;
  const double floor = floor_px(grain);
  int number = 1;
  if (is_later_flight(grain, film, floor)) numbers.unread.push_back({.number = number++});
  const std::size_t flights = grain.fit->curves().size();
  for (std::size_t k = 0; k + 1 < flights; ++k) {
    if (grain.fit->has_impact_after(k)) numbers.of_impacts.push_back(number);
    number += impacts_after(grain, k, floor, number, numbers.unread);
  }
  // After the last bounce that was read, bounces get too low.
  const int last = numbers.of_impacts.back();
  std::erase_if(numbers.unread, [&](const UnreadBounce& one) { return one.number > last; });
  return numbers;
}

}  // namespace repose::vision
