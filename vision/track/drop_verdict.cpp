#include "vision/track/drop_verdict.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "vision/track/film_verdict.h"

namespace repose::vision {
namespace {

constexpr double kGravity_m_s2 = 9.80665;

/// Two things that fly at the same time, well apart and about as clearly seen.
bool is_another_grain(const DropCandidate& grain, const DropCandidate& other) {
  if (other.impacts.empty() || other.flown() < grain.flown() / 2) return false;
  constexpr double kShadow = .5, kAlike = 4;
  const Blob& ours = grain.path->front().blob;
  const Blob& theirs = other.path->front().blob;
  if (theirs.contrast < kShadow * ours.contrast) return false;
  return theirs.area_px < kAlike * ours.area_px && ours.area_px < kAlike * theirs.area_px;
}

std::string of_the_grain(const std::vector<DropCandidate>& candidates) {
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
  return "no bounce was seen from the fall to the rise: the grain is lost at its impact, leaves "
         "the "
         "picture, or hardly rises. Rule: 4 frames in flight on each side of an impact. Fix: take "
         "more frames per second, and keep floor and grain in the picture.";
}

void warn(DropTrack& track, const char* code, std::string message) {
  track.warnings.push_back({.code = code, .message = std::move(message)});
}

/// Films whose container says another frame rate than the camera had: slow motion that plays at 30.
void check_rate(DropTrack& track) {
  if (!track.gravity_m_s2) return;
  const double ratio = track.gravity_m_s2->value / kGravity_m_s2;
  const double sure = track.gravity_m_s2->uncertainty / kGravity_m_s2;
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

void check_lean(DropTrack& track) {
  constexpr double kLean_rad = 2 * std::numbers::pi / 180;
  if (std::abs(track.lean_rad) <= kLean_rad) return;
  warn(track, "leaning",
       fmt::format("gravity leans by {:.1f}° against the picture's upright, and was followed: "
                   "level the camera; the floor counts as level",
                   track.lean_rad * 180 / std::numbers::pi));
}

void check_bounces(DropTrack& track) {
  constexpr int kFew = 6;
  std::vector<std::size_t> few, gaining;
  for (std::size_t k = 0; k < track.bounces.size(); ++k) {
    const Bounce& bounce = track.bounces[k];
    if (std::min(bounce.sightings_before, bounce.sightings_after) < kFew) few.push_back(k + 1);
    if (bounce.restitution.value - bounce.restitution.uncertainty > 1) gaining.push_back(k + 1);
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

}  // namespace

void judge_drop(const FilmGrains& film, const std::vector<DropCandidate>& candidates,
                const FilmScale& scale, DropTrack& track) {
  track.reason = fault_of(film);
  if (track.reason.empty()) track.reason = of_the_grain(candidates);
  if (!track.reason.empty()) {
    track.bounces.clear();
    return;
  }
  if (scale.misses_board()) {
    warn(track, "no_board", fmt::format("heights are by gravity: {}", kNoBoardSeen));
  }
  check_rate(track);
  const bool is_doubtful_film = warn_of_film(film, track.warnings);
  check_lean(track);
  check_bounces(track);
  const auto is_doubtful = [](const Warning& warning) {
    return warning.code == "no_board" || warning.code == "frame_rate" ||
           warning.code == "gains_energy";
  };
  const bool is_flagged =
      is_doubtful_film || std::any_of(track.warnings.begin(), track.warnings.end(), is_doubtful);
  track.status = is_flagged ? MeasureStatus::flagged : MeasureStatus::ok;
}

}  // namespace repose::vision
