#include "vision/track/drop_track.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/units.h"
#include "vision/track/bounce_numbers.h"
#include "vision/track/drop_timing.h"
#include "vision/track/drop_verdict.h"
#include "vision/track/film_grains.h"
#include "vision/track/film_scale.h"
#include "vision/track/film_verdict.h"
#include "vision/track/strobe.h"

namespace repose::vision {
namespace {

constexpr double kGravity_mm_s2 = 9806.65;

/// The straight line sideways that a flight follows: place and speed at a time.
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

/// Height of a fall to a speed, mm: of the scale, or of the millimetres that gravity makes.
Estimate height_mm(const DropCandidate& grain, std::size_t k, bool is_before,
                   const std::optional<Estimate>& mm) {
  Estimate height = grain.fit->estimate(
      k, k + 1, [&](const FlightCurve& before, const FlightCurve& after, const Pull& pull) {
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
      k, k + 1, [](const FlightCurve& before, const FlightCurve& after, const Pull& pull) {
        const double time_s = meeting_time_s(before, after, pull);
        return -speed_at(after, time_s, pull) / speed_at(before, time_s, pull);
      });
  bounce.drop_mm = height_mm(grain, k, true, mm);
  bounce.rebound_mm = height_mm(grain, k, false, mm);
  bounce.sightings_before = fit.curves()[k].sightings;
  bounce.sightings_after = fit.curves()[k + 1].sightings;
  return bounce;
}

/// Of the grain's plane, in the middle of its path, along gravity.
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
  Estimate gravity =
      grain.fit->estimate(0, 0, [&](const FlightCurve&, const FlightCurve&, const Pull& pull) {
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
  track.lean_rad = grain.used_lean_rad;
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
GrainPath flown_path(const DropCandidate& grain) {
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
                                  has_grain ? flown_path(drop.candidates.front()) : GrainPath{});
  }
  return track;
}

}  // namespace repose::vision
