#include "vision/track/drop_timing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "vision/track/flight_fit.h"

namespace repose::vision {
namespace {

/// Candidates with the most flight time, best first.
std::vector<DropCandidate> candidates_in(const FilmGrains& film) {
  constexpr std::size_t kMax = 24;
  std::vector<DropCandidate> candidates;
  for (const GrainPath& path : film.paths) {
    if (candidates.size() == kMax) break;
    candidates.push_back(drop_candidate(path, film));
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    // A clearly visible object comes before its shadow.
    const auto rank = [](const DropCandidate& one) {
      return one.impacts.empty() ? 0 : one.flown() * one.path->back().blob.contrast;
    };
    return rank(a) > rank(b);
  });
  return candidates;
}

/// Whether flights are parabolas much more clearly in the first one: more of the path is in flight,
/// or as much with less scatter.
bool fits_better(const TimedDrop& one, const TimedDrop& other) {
  constexpr double kMore = 1.1, kAsMuch = .95, kLess = .7;
  if (one.candidates.empty() || !one.candidates.front().fit) return false;
  if (other.candidates.empty() || !other.candidates.front().fit) return true;
  const DropCandidate& a = one.candidates.front();
  const DropCandidate& b = other.candidates.front();
  if (a.impacts.size() < b.impacts.size()) return false;
  return a.flown() > kMore * b.flown() ||
         (a.flown() >= kAsMuch * b.flown() && a.fit->noise_px() < kLess * b.fit->noise_px());
}

/// Whether flights are equally good parabolas in the first one.
bool fits_as_well(const TimedDrop& mended, const TimedDrop& known) {
  constexpr double kAsMuch = .98, kNoMore = 1.02;
  const auto& fit = known.candidates.front().fit;
  if (mended.candidates.empty() || !mended.candidates.front().fit) return false;
  if (!fit) return true;
  const DropCandidate& ours = mended.candidates.front();
  return ours.impacts.size() >= known.candidates.front().impacts.size() &&
         ours.flown() >= kAsMuch * fit->sightings() &&
         ours.fit->noise_px() <= kNoMore * fit->noise_px();
}

TimedDrop with_times(const FilmGrains& film, const std::vector<double>& times_s) {
  TimedDrop drop{.film = retimed(film, times_s)};
  drop.candidates = candidates_in(drop.film);
  return drop;
}

/// Displacement from one sighting to the next, which is in the next frame that is not a repeat.
struct Step {
  int frame = 0;  ///< the frame it leads to
  cv::Point2d way;
  bool is_single = false;
};

std::vector<Step> steps_of(const FilmGrains& film, const GrainPath& path) {
  constexpr double kSingle = 1.5;
  std::vector<Step> steps;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const bool is_seen = !path[k].blob.touches_edge && !path[k - 1].blob.touches_edge;
    const double took_s = path[k].time_s - path[k - 1].time_s;
    steps.push_back({.frame = path[k].frame,
                     .way = path[k].blob.centre - path[k - 1].blob.centre,
                     .is_single = is_seen && took_s < kSingle * film.survey.interval_s});
  }
  return steps;
}

/// Number of frames that step k spans, judged by the two steps before it and the two after it,
/// which change evenly in flight: 1, unless it clearly is another integer.
int frames_in(const std::vector<Step>& steps, std::size_t k) {
  constexpr double kMinWay_px = 4, kEven = .15, kMaxChange = .5, kOff = .12, kNoise_px = .6;
  constexpr double kMax = 6;
  for (std::size_t n = k - 2; n <= k + 2; ++n) {
    if (!steps[n].is_single) return 1;
  }
  const cv::Point2d speeds_up = steps[k - 1].way - steps[k - 2].way;
  const cv::Point2d goes_on = steps[k + 2].way - steps[k + 1].way;
  const cv::Point2d mean = .5 * (steps[k - 1].way + steps[k + 1].way);
  const double length = cv::norm(mean);
  const double most_px = kEven * length + kNoise_px;
  if (length < kMinWay_px || cv::norm(speeds_up - goes_on) > most_px) return 1;
  if (cv::norm(speeds_up) > kMaxChange * length) return 1;
  const double times = std::round(steps[k].way.dot(mean) / (length * length));
  if (times < 2 || times > kMax) return 1;
  // Over more frames the speed changes more.
  const cv::Point2d change = steps[k + 1].way - steps[k - 1].way - (times + 1) * speeds_up;
  if (cv::norm(change) > (times + 1) * most_px) return 1;
  const double off_px = cv::norm(steps[k].way - times * mean);
  return off_px < kOff * times * length + kNoise_px ? static_cast<int>(times) : 1;
}

/// Whether three consecutive steps change evenly, as in flight.
bool is_smooth(const Step& a, const Step& b, const Step& c) {
  constexpr double kOff = .15, kNoise_px = .7;
  return a.is_single && b.is_single && c.is_single &&
         cv::norm(c.way - 2 * b.way + a.way) < kOff * cv::norm(b.way) + kNoise_px;
}

/// By how many times the grain's displacement per frame suddenly grows (below 1: shrinks), compared
/// with its continued motion, on a path that stays straight: only the video itself can cause that.
/// 1: it does not.
double sudden_change(const std::vector<Step>& steps, std::size_t k) {
  constexpr double kStraight = .97, kMinWay_px = 1.5;
  if (!is_smooth(steps[k - 2], steps[k - 1], steps[k]) ||
      !is_smooth(steps[k + 2], steps[k + 3], steps[k + 4])) {
    return 1;
  }
  const cv::Point2d& after = steps[k + 2].way;
  const cv::Point2d expected = steps[k].way + 2 * (steps[k].way - steps[k - 1].way);
  const double would = cv::norm(expected), is = cv::norm(after);
  const bool goes_on = expected.dot(after) > kStraight * would * is &&
                       steps[k].way.dot(after) > kStraight * cv::norm(steps[k].way) * is;
  if (!goes_on || std::min({would, is, cv::norm(steps[k].way)}) < kMinWay_px) return 1;
  return is / would;
}

/// By how many times the video's speed changes, at the step where it begins to play faster or
/// slower.
std::optional<double> sudden_change_in(const FilmGrains& film, const GrainPath& path) {
  constexpr double kLeast = 1.8;
  const std::vector<Step> steps = steps_of(film, path);
  for (std::size_t k = 2; k + 4 < steps.size(); ++k) {
    const double change = sudden_change(steps, k);
    if (std::max(change, 1 / change) > kLeast) return std::max(change, 1 / change);
  }
  return std::nullopt;
}

/// Sightings that are in no flight.
std::vector<SeenAt> not_flown(const DropCandidate& grain) {
  std::vector<SeenAt> rest;
  std::size_t k = 0;
  for (const FlightSpan& span : grain.flights.spans) {
    for (; k < span.from; ++k) rest.push_back(grain.seen[k]);
    k = span.to;
  }
  for (; k < grain.seen.size(); ++k) rest.push_back(grain.seen[k]);
  return rest;
}

/// Whether a flight rises and falls, and is long enough for a reliable curvature.
bool is_arc(const std::vector<SeenAt>& path, const FlightSpan& span) {
  constexpr std::size_t kFewest = 7;
  constexpr double kMinSag_px = 8, kSide = .2, kRms = .04;
  if (span.to - span.from < kFewest) return false;
  const Parabola parabola = parabola_through(path, span.from, span.to - span.from);
  const double length_s = path[span.to - 1].time_s - path[span.from].time_s;
  const double sag_px = parabola.acceleration * length_s * length_s / 8;
  if (sag_px < kMinSag_px || parabola.rms_px > kRms * sag_px) return false;
  double top_px = path[span.from].y_px;
  for (std::size_t k = span.from; k < span.to; ++k) top_px = std::min(top_px, path[k].y_px);
  return path[span.from].y_px - top_px > kSide * sag_px &&
         path[span.to - 1].y_px - top_px > kSide * sag_px;
}

/// Flights with a gravity different from that of the flights found: parts of the video play at
/// different speeds. A hand may move a grain along a parabola once, but hardly up and down again.
std::optional<double> speed_change_of(const DropCandidate& grain) {
  constexpr double kSame = 1.6, kNoise_px = .5;
  constexpr std::size_t kFewest = 12;
  if (grain.flights.spans.empty()) return std::nullopt;
  const std::vector<SeenAt> rest = not_flown(grain);
  if (rest.size() < kFewest) return std::nullopt;
  const Flights others = find_flights(rest, kNoise_px);
  if (others.spans.empty() || others.gravity_px_s2 <= 0) return std::nullopt;
  const double ratio = others.gravity_px_s2 / grain.flights.gravity_px_s2;
  if (std::max(ratio, 1 / ratio) < kSame) return std::nullopt;
  const auto arcs = std::count_if(others.spans.begin(), others.spans.end(),
                                  [&](const FlightSpan& span) { return is_arc(rest, span); });
  const std::ptrdiff_t fewest = grain.impacts.empty() ? 1 : 2;
  if (arcs < fewest) return std::nullopt;
  return std::sqrt(std::max(ratio, 1 / ratio));
}

}  // namespace

SkippedFrames skipped_frames(const FilmGrains& film, const GrainPath& path) {
  SkippedFrames found{.times_s = film.survey.times_s};
  const std::vector<Step> steps = steps_of(film, path);
  for (std::size_t k = 2; k + 2 < steps.size(); ++k) {
    const int more = frames_in(steps, k) - 1;
    if (more <= 0) continue;
    found.count += more;
    for (std::size_t n = static_cast<std::size_t>(steps[k].frame); n < found.times_s.size(); ++n) {
      found.times_s[n] += more * film.survey.interval_s;
    }
  }
  return found;
}

TimedDrop timed_drop(FilmGrains film) {
  TimedDrop best{.film = std::move(film)};
  best.candidates = candidates_in(best.film);
  const std::vector<std::vector<double>> others = best.film.other_times_s;
  for (const std::vector<double>& times_s : others) {
    TimedDrop mended = with_times(best.film, times_s);
    if (!fits_better(mended, best)) continue;
    best = std::move(mended);
    best.has_own_times = true;
  }
  if (best.candidates.empty()) return best;
  const SkippedFrames skipped = skipped_frames(best.film, *best.candidates.front().path);
  if (skipped.count > 0) {
    TimedDrop mended = with_times(best.film, skipped.times_s);
    if (fits_as_well(mended, best)) {
      mended.has_own_times = best.has_own_times;
      mended.skipped_frames = skipped.count;
      best = std::move(mended);
    }
  }
  const DropCandidate& grain = best.candidates.front();
  best.speed_change = sudden_change_in(best.film, *grain.path);
  if (!best.speed_change) best.speed_change = speed_change_of(grain);
  return best;
}

}  // namespace repose::vision
