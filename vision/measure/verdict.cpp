#include "vision/measure/verdict.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "vision/measure/camera_pitch.h"

namespace repose::vision {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Refusals.
constexpr double kMinConfidence = 0.35;
constexpr double kFlattest_rad = 4 * kDegree;
constexpr double kSteepest_rad = 65 * kDegree;
constexpr double kFewestGrains = 2.5;
constexpr double kLeastR2 = 0.85;
constexpr double kRoundest_rad = 17 * kDegree;  // the upper half of a ball lies 20 degrees flatter
constexpr double kLargestPitch_rad = 10 * kDegree;
constexpr double kLargestSpread_rad = 12 * kDegree;

// Warnings that ask a person to look.
constexpr double kDoubtfulConfidence = 0.55;
constexpr double kDoubtfulPitch_rad = 5 * kDegree;
constexpr double kPitchTolerance_rad = 6 * kDegree;
constexpr double kDoubtfulBend_rad = 10 * kDegree;
constexpr double kDoubtfulSpread_rad = 3 * kDegree;

// Warnings to know of.
constexpr double kFewGrains = 10;
constexpr double kFewSteps = 5;
constexpr double kLowHeap_px = 40;
constexpr double kUnequal_rad = 6 * kDegree;
constexpr double kTilted_rad = 3 * kDegree;

double degrees(double rad) { return rad / kDegree; }

void refuse(ReposeAngle& result, std::string reason) {
  result.status = MeasureStatus::refused;
  result.reason = std::move(reason);
  result.angle_rad.reset();
  result.uncertainty_rad.reset();
  for (Flank* flank : {&result.left, &result.right}) {
    flank->angle_rad.reset();
    flank->uncertainty_rad.reset();
  }
}

void note(ReposeAngle& result, std::string code, std::string message) {
  result.warnings.push_back({std::move(code), std::move(message)});
}

void flag(ReposeAngle& result, std::string code, std::string message) {
  result.status = MeasureStatus::flagged;
  note(result, std::move(code), std::move(message));
}

/// The boundary's quality, lowered when equally good segmentations disagree.
double confidence_of(const Choice& choice) {
  const double boundary = std::clamp(choice.best.score / 0.55, 0.0, 1.0);
  const double disagreement = degrees(choice.disagreement_rad) / 2;
  return boundary * std::exp(-disagreement * disagreement);
}

/// Why a flank is none; empty when it is one, or absent.
std::string reason_against(const FlankFit& flank, const std::string& name) {
  if (flank.status != FlankStatus::ok) return {};
  if (flank.angle_rad < kFlattest_rad) {
    return fmt::format(
        "the {} side is level ({:.1f} degrees): this is a layer, not a heap. Fix: picture a heap "
        "whose flanks end on the ground.",
        name, degrees(flank.angle_rad));
  }
  if (flank.angle_rad > kSteepest_rad) {
    return fmt::format(
        "the {} side stands at {:.0f} degrees, steeper than loose grains lie. Fix: lay an "
        "excluded box over walls, gates and tubes.",
        name, degrees(flank.angle_rad));
  }
  if (flank.bend_rad < -kRoundest_rad) {
    return fmt::format(
        "the {} side is round, {:.0f} degrees flatter at the top than at the foot: no straight "
        "flank. Fix: check that the picture shows a heap.",
        name, -degrees(flank.bend_rad));
  }
  if (flank.window_spread_rad > kLargestSpread_rad) {
    return fmt::format(
        "the {} side's angle changes by {:.0f} degrees with the stretch that is fitted: no "
        "straight "
        "flank, or a heap and its plate taken for one thing. Fix: use a level camera and a plate "
        "of "
        "another colour than the grains.",
        name, degrees(flank.window_spread_rad));
  }
  if (flank.least_squares.r2 < kLeastR2) {
    return fmt::format(
        "the {} side's edge is no line (r2 {:.2f}). Fix: use a plainer backdrop, or lay an "
        "excluded "
        "box over what stands before the flank.",
        name, flank.least_squares.r2);
  }
  return {};
}

/// Why there is no number at all; empty when there is one.
std::string reason_to_refuse(const Choice& choice, const MeasureOptions& options,
                             double confidence) {
  const Reading& best = choice.best;
  if (best.body.mask.empty()) {
    return "no heap stands out from the backdrop. Fix: use a plain backdrop of another colour than "
           "the grains, even light, and show the ground left and right of the heap.";
  }
  if (!best.has_flank()) {
    return fmt::format(
        "no sloping flank found (left: {}; right: {}). Fix: picture a heap with at least one free "
        "flank and its foot in the frame.",
        best.left.reason.empty() ? "none" : best.left.reason,
        best.right.reason.empty() ? "none" : best.right.reason);
  }
  if (confidence < kMinConfidence) {
    return fmt::format(
        "the heap's edge is too uncertain (confidence {:.2f} of 1). Fix: use a plain backdrop of "
        "another colour than the grains, even light and a sharp picture; lay an excluded box over "
        "foreign things.",
        confidence);
  }
  if (best.profile.leaves_frame_top) {
    return "the crest lies outside the picture, so the heap's height is unknown. Fix: step back or "
           "tilt the camera until the whole heap is in the frame.";
  }
  const double pitch = pitch_from_bow(best.body.ground.bow.value_or(0));
  if (!options.camera_pitch_rad && pitch > kLargestPitch_rad) {
    return fmt::format(
        "the base bows downwards as if the camera looked down by about {:.0f} degrees, which "
        "changes the angle; or this is no heap. Fix: retake with a level camera at the heap's "
        "height, or give the camera pitch if it is known.",
        degrees(pitch));
  }
  if (best.grain && best.profile.crest_height < kFewestGrains * *best.grain) {
    return "the thing found is hardly higher than its grains: no heap. Fix: picture a heap at "
           "least 10 grains high.";
  }
  for (const Side side : {Side::left, Side::right}) {
    const std::string reason =
        reason_against(best.flank(side), side == Side::left ? "left" : "right");
    if (!reason.empty()) return reason;
  }
  return {};
}

void warn_of_flank(ReposeAngle& result, const FlankFit& flank, const std::string& name) {
  if (flank.status != FlankStatus::ok) {
    note(result, flank.status == FlankStatus::truncated ? "flank_truncated" : "one_flank",
         fmt::format("No {} flank: {}. The angle is that of the other side alone.", name,
                     flank.reason));
    return;
  }
  if (flank.frame_cut) {
    note(result, "flank_cut_by_frame",
         fmt::format("The picture's edge cuts the {} flank; only the part above is fitted.", name));
  }
  if (flank.apron_cut) {
    note(result, "apron_left_out",
         fmt::format("A thin apron at the {} foot is left out of the line.", name));
  }
  if (std::abs(flank.bend_rad) > kDoubtfulBend_rad) {
    flag(result, "bent_flank",
         fmt::format(
             "The {} flank is {}: its slope differs by {:.0f} degrees between its lower and "
             "upper half, so one angle does not describe it.",
             name, flank.bend_rad > 0 ? "concave" : "convex", std::abs(degrees(flank.bend_rad))));
  }
  if (flank.window_spread_rad > kDoubtfulSpread_rad) {
    flag(result, "window_sensitive",
         fmt::format("The {} angle changes by {:.1f} degrees with the stretch that is fitted.",
                     name, degrees(flank.window_spread_rad)));
  }
}

void warn_of_size(ReposeAngle& result, const Reading& best, const MeasureOptions& options) {
  if (best.profile.crest_height < kLowHeap_px) {
    flag(result, "low_heap",
         fmt::format("The heap is only {:.0f} pixels high: take the picture from closer by.",
                     best.profile.crest_height));
  }
  if (!best.grain) return;
  const double grains = best.profile.crest_height / *best.grain;
  const double steps = grains * (options.window_to - options.window_from);
  if (grains < kFewGrains || steps < kFewSteps) {
    note(
        result, "few_grains",
        fmt::format("About {:.0f} grains high, {:.0f} in the window: single grains move the angle.",
                    grains, steps));
  }
}

void warn_of_scene(ReposeAngle& result, const Choice& choice, const MeasureOptions& options) {
  const Reading& best = choice.best;
  const Ground& ground = best.body.ground;
  const double pitch = pitch_from_bow(ground.bow.value_or(0));
  if (!options.camera_pitch_rad && pitch > kDoubtfulPitch_rad) {
    flag(result, "base_bows",
         fmt::format("The base bows as if the camera looked down by about {:.0f} degrees; give "
                     "the camera pitch if it did.",
                     degrees(pitch)));
  }
  if (options.camera_pitch_rad && ground.bow &&
      std::abs(pitch - std::max(0.0, *options.camera_pitch_rad)) > kPitchTolerance_rad) {
    flag(result, "pitch_disagrees",
         fmt::format("The base bows as for a pitch of {:.0f} degrees, not of the {:.0f} given.",
                     degrees(pitch), degrees(*options.camera_pitch_rad)));
  }
  if (std::abs(ground.tilt_rad()) > kTilted_rad) {
    note(result, "tilted_picture",
         fmt::format("The ground is tilted by {:.1f} degrees in the picture; angles are measured "
                     "from it.",
                     degrees(ground.tilt_rad())));
  }
  if (ground.behind) {
    flag(result, "edge_behind",
         "The line taken for the ground is an edge behind the heap, which goes on below it: its "
         "foot is not seen. Use a plate of another colour than the grains.");
  }
  if (ground.mirrored) {
    note(result, "mirror", "The ground line is the axis of the heap's reflection.");
  }
  if (result.strays > 0) {
    note(result, "strays",
         fmt::format("{} small thing{} beside the heap {} left out.", result.strays,
                     result.strays == 1 ? "" : "s", result.strays == 1 ? "is" : "are"));
  }
  if (best.left.status == FlankStatus::ok && best.right.status == FlankStatus::ok &&
      std::abs(best.left.angle_rad - best.right.angle_rad) > kUnequal_rad) {
    note(result, "unequal_flanks",
         fmt::format("The two flanks differ by {:.1f} degrees.",
                     degrees(std::abs(best.left.angle_rad - best.right.angle_rad))));
  }
}

}  // namespace

void judge(ReposeAngle& result, const Choice& choice, const MeasureOptions& options) {
  result.status = MeasureStatus::ok;
  result.confidence = confidence_of(choice);
  const std::string reason = reason_to_refuse(choice, options, result.confidence);
  if (!reason.empty()) {
    refuse(result, reason);
    return;
  }
  if (result.confidence < kDoubtfulConfidence) {
    flag(result, "weak_edge",
         fmt::format("The heap's edge is uncertain (confidence {:.2f} of 1): check the overlay.",
                     result.confidence));
  }
  warn_of_flank(result, choice.best.left, "left");
  warn_of_flank(result, choice.best.right, "right");
  warn_of_size(result, choice.best, options);
  warn_of_scene(result, choice, options);
}

}  // namespace repose::vision
