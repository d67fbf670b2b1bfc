#include "vision/track/drop_track.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/units.h"
#include "vision/film/frame_times.h"
#include "vision/track/drop_candidate.h"
#include "vision/track/drop_timing.h"
#include "vision/track/film_grains.h"
#include "vision/track/film_scale.h"

namespace repose::vision {

namespace {

/// Whether two things fly at the same time, about equally clearly visible.
bool is_another_grain(const DropCandidate& grain, const DropCandidate& other) {
  if (other.impacts.empty() || other.flown() < grain.flown() / 2) return false;
  constexpr double kShadow = .5, kAlike = 4;
  const Blob& ours = grain.path->front().blob;
  const Blob& theirs = other.path->front().blob;
  if (theirs.contrast < kShadow * ours.contrast) return false;
  return theirs.area_px < kAlike * ours.area_px && ours.area_px < kAlike * theirs.area_px;
}

std::string of_the_grain(const TimedDrop& drop) {
  const std::vector<DropCandidate>& candidates = drop.candidates;
  const DropCandidate& grain = candidates.front();
  if (!grain.impacts.empty()) {
    for (std::size_t k = 1; k < candidates.size(); ++k) {
      if (!is_another_grain(grain, candidates[k])) continue;
      const Blob& other = candidates[k].path->front().blob;
      return fmt::format(
          "several grains bounce: another one is at {:.0f}, {:.0f} first. Rule: one grain. Fix: "
          "drop one at a time, and cut the film to one drop.",
          other.centre.x, other.centre.y);
    }
    return {};
  }
  const bool any_flight =
      std::any_of(candidates.begin(), candidates.end(), [](const auto& one) { return one.fit; });
  if (!any_flight) {
    return "nothing that moves falls freely: no part of a path is a parabola. Fix: film a drop "
           "from "
           "the side, at 60 frames per second or more, with the whole fall in the picture.";
  }
  if (drop.speed_change) {
    return fmt::format(
        "the film changes its speed: in a part of it all goes {:.2g} times as fast as in the rest. "
        "Rule: one speed all through. Fix: give the film as the camera stored it, without slow "
        "motion in a "
        "part of it, or cut it to a part of one speed that shows the fall and a bounce.",
        *drop.speed_change);
  }
  return "no bounce was seen from the fall to the rise: the grain is lost at its impact, leaves "
         "the "
         "picture, or hardly rises. Rule: 4 frames in flight on each side of an impact. Fix: take "
         "more frames per second, and keep floor and grain in the picture.";
}

void warn(DropTrack& track, const char* code, std::string message) {
  track.warnings.push_back({.code = code, .message = std::move(message)});
}

/// Videos whose container states a frame rate other than the camera's: slow motion played at 30.
void check_rate(DropTrack& track) {
  if (!track.gravity_m_s2) return;
  const double ratio = track.gravity_m_s2->value / kStandardGravity_m_s2;
  const double sure = track.gravity_m_s2->uncertainty / kStandardGravity_m_s2;
  constexpr double kTolerated = .05;
  if (std::abs(ratio - 1) < std::max(kTolerated, sure)) return;
  warn(track, "frame_rate",
       fmt::format("by the scale and the film's time stamps gravity is {:.2f} m/s²: the film plays "
                   "{:.2f} times slower than it was taken (at {:.0f} frames per second, if the "
                   "scale is right), or the scale is not in the grain's plane. Restitution and "
                   "heights do not depend on the frame rate",
                   track.gravity_m_s2->value, 1 / std::sqrt(ratio),
                   track.film.frames_per_s / std::sqrt(ratio)));
}

/// Without a scale, checks for plausible sizes: drops of 2 mm to 10 m, grains of 0.1 to 300 mm. A
/// video played n times slower than it was taken makes both n^2 times as large.
void check_size(DropTrack& track) {
  if (track.has_scale) return;
  constexpr double kLowest_mm = 2, kHighest_mm = 1e4, kSmallest_mm = .1, kLargest_mm = 300;
  const double drop_mm = track.bounces.front().drop_mm.value;
  const double grain_mm = track.grain_px * track.mm_per_px.value_or(0);
  if (drop_mm > kLowest_mm && drop_mm < kHighest_mm && grain_mm > kSmallest_mm &&
      grain_mm < kLargest_mm) {
    return;
  }
  warn(track, "frame_rate",
       fmt::format("at the film's {:.4g} frames per second gravity makes the fall {:.3g} mm high "
                   "and the grain {:.3g} mm wide, which cannot be: the film plays slower or faster "
                   "than it was taken. Heights need a scale; restitution does not",
                   track.film.frames_per_s, drop_mm, grain_mm));
}

void check_times(const TimedDrop& drop, DropTrack& track) {
  if (drop.has_own_times && drop.film.repeated.count == 0) {
    warn(track, "uneven_stamps",
         "its time stamps come unevenly, and the flights show that its frames were taken evenly: "
         "the times used are even");
  }
  if (drop.skipped_frames > 0) {
    warn(track, "skipped_frames",
         fmt::format("{} frames were left out behind time stamps that do not show it: the grain "
                     "goes several frames' way at once, and that time was put in again. Heights by "
                     "gravity are wrong if the film was made shorter by it",
                     drop.skipped_frames));
  }
  if (drop.speed_change) {
    warn(track, "speed_changes",
         fmt::format("the film changes its speed: in a part of it all goes {:.2g} times as fast as "
                     "in the rest. Give the film as the camera stored it",
                     *drop.speed_change));
  }
}

/// The number of sightings in flight before or after a time, whichever is smaller.
int flown_beside(double time_s, const DropCandidate& grain) {
  int before = 0, after = 0;
  for (const FlightSpan& span : grain.flights.spans) {
    for (std::size_t k = span.from; k < span.to; ++k) {
      ++(grain.seen[k].time_s < time_s ? before : after);
    }
  }
  return std::min(before, after);
}

/// Heights by gravity depend on the time stamps. If the intervals are longer in a part of the
/// video, flights on both sides with the same gravity confirm them; nothing else does.
void check_even_rate(const TimedDrop& drop, DropTrack& track) {
  constexpr int kEnough = 6;
  const DropCandidate& grain = drop.candidates.front();
  if (track.has_scale || drop.speed_change) return;
  for (const RateChange& change : rate_changes(drop.film.survey.times_s)) {
    const double at_s = drop.film.survey.times_s[change.frame];
    if (at_s > grain.seen.back().time_s) break;
    if (flown_beside(at_s, grain) >= kEnough) continue;
    warn(track, "speed_changes",
         fmt::format("from {:.2f} s on the film's frames follow every {:.3g} ms, and every {:.3g} "
                     "ms before: if a part of it was slowed down, heights by gravity are wrong by "
                     "the square of that. Restitution is not. Give a scale, or the film as the "
                     "camera stored it",
                     at_s, 1e3 * change.after_s, 1e3 * change.before_s));
    return;
  }
}

std::string joined_numbers(const std::vector<UnreadBounce>& bounces) {
  std::vector<int> numbers;
  for (const UnreadBounce& one : bounces) numbers.push_back(one.number);
  return fmt::format("{}", fmt::join(numbers, ", "));
}

void check_numbers(DropTrack& track) {
  if (!track.unread_bounces.empty()) {
    warn(track, "unread_bounces",
         fmt::format("bounce {} was not read: too few frames of a flight beside it, or the grain "
                     "was not seen",
                     joined_numbers(track.unread_bounces)));
  }
  if (!track.has_first_bounce()) {
    warn(track, "first_bounce_missing",
         fmt::format("the first bounce was not read: the one that comes first here is the "
                     "grain's {}. or a later one. Film from before the release, with more frames "
                     "per second",
                     track.bounces.front().number));
  }
}

void check_lean(DropTrack& track) {
  constexpr double kLean_rad = 2 * std::numbers::pi / 180;
  if (std::abs(track.roll_rad) <= kLean_rad) return;
  warn(track, "leaning",
       fmt::format("gravity leans by {:.1f}° against the picture's upright, and was followed: "
                   "level the camera; the floor counts as level",
                   to_degrees(track.roll_rad)));
}

void check_bounces(DropTrack& track) {
  constexpr int kFew = 6;
  std::vector<int> few, gaining;
  for (const Bounce& bounce : track.bounces) {
    const int number = bounce.number;
    if (std::min(bounce.sightings_before, bounce.sightings_after) < kFew) few.push_back(number);
    if (bounce.restitution.value - bounce.restitution.uncertainty > 1) gaining.push_back(number);
  }
  if (!few.empty()) {
    warn(track, "few_frames",
         fmt::format("fewer than {} frames on one side of bounce {}: film with more frames per "
                     "second",
                     kFew, fmt::join(few, ", ")));
  }
  if (!gaining.empty()) {
    warn(track, "gains_energy",
         fmt::format("bounce {} rises higher than it fell: the grain was thrown, spins, or is not "
                     "filmed from the side",
                     fmt::join(gaining, ", ")));
  }
}

/// Sets the status, with the warnings or the reason for a refusal. A refused track has no bounces.
void judge_drop(const TimedDrop& drop, const FilmScale& scale, DropTrack& track) {
  track.reason = fault_of(drop.film);
  if (track.reason.empty()) track.reason = of_the_grain(drop);
  if (!track.reason.empty()) {
    track.bounces.clear();
    track.unread_bounces.clear();
    return;
  }
  if (scale.misses_board()) {
    warn(track, "no_board", fmt::format("heights are by gravity: {}", kNoBoardSeen));
  }
  check_rate(track);
  check_size(track);
  const bool is_doubtful_film = warn_of_film(drop.film, track.warnings);
  check_times(drop, track);
  check_even_rate(drop, track);
  check_numbers(track);
  check_lean(track);
  check_bounces(track);
  constexpr std::array<std::string_view, 6> kDoubtful = {"no_board",      "frame_rate",
                                                         "gains_energy",  "skipped_frames",
                                                         "speed_changes", "first_bounce_missing"};
  const auto is_doubtful = [&](const Warning& warning) {
    return std::ranges::find(kDoubtful, warning.code) != kDoubtful.end();
  };
  const bool is_flagged =
      is_doubtful_film || std::any_of(track.warnings.begin(), track.warnings.end(), is_doubtful);
  track.status = is_flagged ? MeasureStatus::flagged : MeasureStatus::ok;
}

constexpr double kGravity_mm_s2 = 9806.65;

/// The straight horizontal motion of a flight: position and speed at a given time.
std::array<double, 2> sideways(const DropCandidate& grain, std::size_t k, double time_s) {
  const auto [from, to] = grain.flights.spans[k];
  double mean_t = 0, mean_x = 0, tt = 0, tx = 0;
  const auto count = static_cast<double>(to - from);
  for (std::size_t n = from; n < to; ++n) {
    mean_t += grain.seen[n].time_s / count;
    mean_x += grain.seen[n].x_px / count;
  }
  for (std::size_t n = from; n < to; ++n) {
    const double t = grain.seen[n].time_s - mean_t;
    tt += t * t;
    tx += t * (grain.seen[n].x_px - mean_x);
  }
  const double speed = tt > 0 ? tx / tt : 0;
  return {mean_x + speed * (time_s - mean_t), speed};
}

Point place_at(const DropCandidate& grain, std::size_t k, double time_s) {
  const FlightCurve& curve = grain.fit->curves()[k];
  const double y = height_at(curve, time_s, grain.fit->pull());
  const cv::Point2d at = upright(sideways(grain, k, time_s)[0], y, grain.used_lean_rad);
  return {at.x, at.y};
}

FlightPath path_of(const DropCandidate& grain, std::size_t k) {
  const FlightFit& fit = *grain.fit;
  const FlightCurve& curve = fit.curves()[k];
  const double begin_s =
      k > 0 && fit.has_impact_after(k - 1) ? fit.impact_time_s(k - 1) : curve.begins_s;
  const double end_s = fit.has_impact_after(k) ? fit.impact_time_s(k) : curve.ends_s;
  FlightPath path;
  constexpr int kParts = 48;
  for (int n = 0; n <= kParts; ++n) {
    path.curve.push_back(place_at(grain, k, begin_s + (end_s - begin_s) * n / kParts));
  }
  const double highest_s = top_s(curve, fit.pull());
  path.has_top = highest_s > begin_s && highest_s < end_s;
  if (path.has_top) path.top = place_at(grain, k, highest_s);
  return path;
}

/// Fall height to reach a speed, in mm of the scale, or in millimetres implied by gravity.
Estimate height_mm(const DropCandidate& grain, std::size_t k, bool is_before,
                   const std::optional<Estimate>& mm) {
  Estimate height = grain.fit->estimate(
      k, k + 1,
      [&](const FlightCurve& before, const FlightCurve& after, const FlightDynamics& pull) {
        const double time_s = meeting_time_s(before, after, pull);
        const double speed = speed_at(is_before ? before : after, time_s, pull);
        return speed * speed / (2 * pull.gravity) *
               (mm ? mm->value : kGravity_mm_s2 / pull.gravity);
      });
  if (mm) {
    height.uncertainty = std::hypot(height.uncertainty, height.value * mm->uncertainty / mm->value);
  }
  return height;
}

Bounce bounce_after(const DropCandidate& grain, std::size_t k, const std::optional<Estimate>& mm) {
  const FlightFit& fit = *grain.fit;
  Bounce bounce{.time_s = fit.impact_time_s(k)};
  bounce.place = place_at(grain, k, bounce.time_s);
  bounce.restitution = fit.estimate(
      k, k + 1,
      [](const FlightCurve& before, const FlightCurve& after, const FlightDynamics& pull) {
        const double time_s = meeting_time_s(before, after, pull);
        return -speed_at(after, time_s, pull) / speed_at(before, time_s, pull);
      });
  bounce.drop_mm = height_mm(grain, k, true, mm);
  bounce.rebound_mm = height_mm(grain, k, false, mm);
  bounce.sightings_before = fit.curves()[k].sightings;
  bounce.sightings_after = fit.curves()[k + 1].sightings;
  return bounce;
}

/// Scale in the grain's plane, at the middle of its path, along gravity.
std::optional<Estimate> mm_per_px_of(const DropCandidate& grain, const FilmScale& scale) {
  if (!scale.exists()) return std::nullopt;
  cv::Point2d middle(0, 0);
  for (const Sighting& one : *grain.path) {
    middle += one.blob.centre / static_cast<double>(grain.path->size());
  }
  return scale.mm_per_px(middle, upright(0, 1, grain.used_lean_rad));
}

void read_scale(const DropCandidate& grain, const std::optional<Estimate>& mm, DropTrack& track) {
  track.gravity_px_s2 = grain.fit->pull().gravity;
  track.has_scale = mm.has_value();
  track.mm_per_px = kGravity_mm_s2 / track.gravity_px_s2;
  if (!mm) return;
  track.mm_per_px = mm->value;
  Estimate gravity = grain.fit->estimate(
      0, 0, [&](const FlightCurve&, const FlightCurve&, const FlightDynamics& pull) {
        return pull.gravity * mm->value / kMmPerM;
      });
  gravity.uncertainty =
      std::hypot(gravity.uncertainty, gravity.value * mm->uncertainty / mm->value);
  track.gravity_m_s2 = gravity;
}

void read_grain(const DropCandidate& grain, const FilmGrains& film, const FilmScale& scale,
                DropTrack& track) {
  const FlightFit& fit = *grain.fit;
  const std::optional<Estimate> mm = mm_per_px_of(grain, scale);
  read_scale(grain, mm, track);
  track.board = scale.board();
  track.roll_rad = grain.used_lean_rad;
  track.readout_ms = kMmPerM * fit.readout_s_per_px() * film.survey.size.height;
  track.noise_px = fit.noise_px();
  std::vector<double> areas;
  for (const Sighting& one : *grain.path) {
    areas.push_back(one.blob.area_px);
    track.places.push_back({one.time_s, {one.blob.centre.x, one.blob.centre.y}});
  }
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  track.grain_px = 2 * std::sqrt(*middle / CV_PI);
  for (std::size_t k = 0; k < fit.curves().size(); ++k) track.flights.push_back(path_of(grain, k));
  const BounceNumbers numbers = number_bounces(grain, film);
  for (std::size_t n = 0; n < grain.impacts.size(); ++n) {
    track.bounces.push_back(bounce_after(grain, grain.impacts[n], mm));
    track.bounces.back().number = numbers.of_impacts[n];
  }
  track.unread_bounces = numbers.unread;
}

/// The part of the grain's path that was fitted.
GrainPath fitted_path(const DropCandidate& grain) {
  GrainPath path;
  const double begin_s = grain.fit->curves().front().begins_s;
  const double end_s = grain.fit->curves().back().ends_s;
  for (const Sighting& one : *grain.path) {
    if (one.time_s >= begin_s && one.time_s <= end_s) path.push_back(one);
  }
  return path;
}

}  // namespace

DropTrack track_drop(const FilmFile& file, const TrackOptions& options) {
  const TimedDrop drop = timed_drop(grains_in_film(file, options.progress));
  const FilmGrains& film = drop.film;
  DropTrack track{.film = facts_of(film.survey)};
  const bool has_grain = !drop.candidates.empty() && !drop.candidates.front().impacts.empty();
  const FilmScale scale(options, film.scene, file.lens);
  if (has_grain) read_grain(drop.candidates.front(), film, scale, track);
  judge_drop(drop, scale, track);
  if (options.draws_strobe && !film.scene.empty()) {
    track.strobe = strobe_picture(file, film.scene,
                                  has_grain ? fitted_path(drop.candidates.front()) : GrainPath{});
  }
  return track;
}

}  // namespace repose::vision
