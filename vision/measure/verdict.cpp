#include "vision/measure/verdict.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "base/units.h"
#include "vision/measure/camera_pitch.h"
#include "vision/measure/reading.h"
#include "vision/measure/repose_angle.h"

/// Judges the sides of a heap and the picture as a whole.

namespace repose::vision {

namespace {

/// Tells the user something that does not cast doubt on the number.
inline void note(ReposeAngle& result, std::string code, std::string message) {
  result.warnings.push_back({std::move(code), std::move(message)});
}

/// Tells the user why the result must be checked before use.
inline void flag(ReposeAngle& result, std::string code, std::string message) {
  result.status = MeasureStatus::flagged;
  note(result, std::move(code), std::move(message));
}

// Refusals.
constexpr double kFlattest_rad = 4 * kDegree;

constexpr double kSteepest_rad = 65 * kDegree;

constexpr double kMinR2 = 0.85;

constexpr double kRoundest_rad = 17 * kDegree;  // the upper half of a ball is 20 degrees flatter

constexpr double kLargestSpread_rad = 12 * kDegree;

// Warnings that require a check by the user.
constexpr double kDoubtfulBend_rad = 10 * kDegree;

constexpr double kUncoveredSpread_rad = 1 * kDegree;  // beyond the interval

/// Largest change of the angle with another window, or with a high apron at full weight.
double spread_rad(const FlankFit& flank) {
  const bool is_high = flank.apron && flank.apron->is_high;
  return is_high ? std::max(flank.window_spread_rad, flank.apron_rad) : flank.window_spread_rad;
}

/// Why a side is not a flank, and what to do; empty if it is one, or absent.
std::string reason_against(const FlankFit& flank, Side side) {
  const std::string_view name = name_of(side);
  if (flank.status != FlankStatus::ok) return {};
  if (flank.angle_rad < kFlattest_rad) {
    return fmt::format(
        "the {} side is level ({:.1f} degrees): this is a layer, not a heap. Fix: photograph a "
        "heap "
        "whose flanks end on the ground.",
        name, to_degrees(flank.angle_rad));
  }
  if (flank.angle_rad > kSteepest_rad) {
    return fmt::format(
        "the {} side has a slope of {:.0f} degrees, too steep for loose grains. Fix: cover walls, "
        "gates and tubes with an {}.",
        name, to_degrees(flank.angle_rad), base::field("excluded box"));
  }
  if (flank.bend_rad < -kRoundest_rad) {
    return fmt::format(
        "the {} side is round, {:.0f} degrees flatter at the top than at the foot: not a straight "
        "flank. Fix: check that the picture shows a heap.",
        name, -to_degrees(flank.bend_rad));
  }
  if (spread_rad(flank) > kLargestSpread_rad) {
    return fmt::format(
        "the {} side's angle changes by {:.0f} degrees with the window: not a straight flank, or a "
        "heap and its plate taken for one object. Fix: use a level camera and a plate of a "
        "different colour from the grains.",
        name, to_degrees(spread_rad(flank)));
  }
  if (flank.least_squares.r2 < kMinR2) {
    return fmt::format(
        "the {} side's edge is not a line (r2 {:.2f}). Fix: use a plainer backdrop, or cover what "
        "is in front of the flank with an {}.",
        name, flank.least_squares.r2, base::field("excluded box"));
  }
  return {};
}

/// Adds warnings about a side, and flags those that require a check. `result` has its intervals.
/// @param fitted  by the requested definition; `reading` has the flank by the default one
void warn_of_flank(ReposeAngle& result, const Reading& reading, const FlankFit& fitted, Side side) {
  const FlankFit& flank = reading.flank(side);
  const std::string_view name = name_of(side);
  if (reading.walled == side) {
    if (reading.is_wall_a_flank) {
      flag(result, "second_flank",
           fmt::format("The {} side slopes like a flank, though the heap was said to end at a wall "
                       "there: check the overlay.",
                       name));
    }
    return;
  }
  if (flank.status != FlankStatus::ok) {
    note(result, flank.status == FlankStatus::truncated ? "flank_truncated" : "one_flank",
         fmt::format("No {} flank: {}. The angle is that of the other side alone.", name,
                     flank.reason));
    return;
  }
  if (fitted.frame_cut) {
    note(result, "flank_cut_by_frame",
         fmt::format("The picture's edge cuts off the {} flank: it is fitted above {:.0f} % of the "
                     "height.",
                     name, 100 * fitted.window_from));
  }
  const Flank& shown = side == Side::left ? result.left : result.right;
  if (flank.apron && shown.apron) {
    note(result, "apron_left_out",
         fmt::format("The {} foot is an apron, much flatter than the flank above it, and hardly "
                     "counts: the line starts at {:.0f} % of the height. If it counted in full, "
                     "this side would have {:.1f} degrees; the interval covers that.",
                     name, 100 * flank.apron->from, to_degrees(shown.apron->angle_with_rad)));
    if (flank.apron->is_high) {
      flag(result, "high_apron",
           fmt::format("On the {} the foot levels out at {:.0f} % of the height: the line is that "
                       "of the part above, which is not most of the flank.",
                       name, 100 * flank.apron->from));
    }
  }
  if (flank.sure_bend_rad() > kDoubtfulBend_rad) {
    flag(result, "bent_flank",
         fmt::format("The {} flank is {}: its slope differs by {:.0f} degrees between its lower "
                     "and upper half, so one angle does not describe it.",
                     name, flank.bend_rad > 0 ? "concave" : "convex",
                     std::abs(to_degrees(flank.bend_rad))));
  }
  if (fitted.window_spread_rad > shown.uncertainty_rad.value_or(0) + kUncoveredSpread_rad) {
    flag(result, "window_sensitive",
         fmt::format("The {} angle changes by {:.1f} degrees with the window, more than its "
                     "interval covers.",
                     name, to_degrees(fitted.window_spread_rad)));
  }
}

// Refusals.
constexpr double kMinConfidence = 0.35;
constexpr double kMinToldConfidence = 0.1;  // if the user has marked the heap
constexpr double kFewestGrainsInHeight = 2.5;
constexpr double kLargestSeenPitch_rad = 10 * kDegree;

// Warnings that require a check by the user.
constexpr double kDoubtfulConfidence = 0.65;
constexpr double kDoubtfulPitch_rad = 5 * kDegree;
constexpr double kPitchTolerance_rad = 6 * kDegree;
constexpr double kMaxOfUnlike = 0.5;  // confidence in what may not be a heap
constexpr double kWideInterval_rad = 5 * kDegree;
constexpr double kTooUnequal_rad = 15 * kDegree;
constexpr double kHollow_rad = 3 * kDegree;    // more than drawn straight flanks ever show
constexpr double kFarApart_rad = 3 * kDegree;  // definitions, beyond the interval

// Warnings for information.
constexpr double kFewGrains = 10;
constexpr double kFewSteps = 5;
constexpr double kLowHeap_px = 40;
constexpr double kUnequal_rad = 6 * kDegree;
constexpr double kTilted_rad = 3 * kDegree;

void refuse(ReposeAngle& result, std::string reason) {
  result.status = MeasureStatus::refused;
  result.reason = std::move(reason);
  result.angle_rad.reset();
  result.uncertainty_rad.reset();
  result.own_uncertainty_rad.reset();
  result.camera_uncertainty_rad.reset();
  for (Flank* flank : {&result.left, &result.right}) {
    flank->angle_rad.reset();
    flank->uncertainty_rad.reset();
  }
}

/// The boundary's quality, lowered when equally good segmentations disagree.
double confidence_of(const SelectedCandidate& choice) {
  const double boundary = std::clamp(choice.best.score / 0.55, 0.0, 1.0);
  const double disagreement = to_degrees(choice.disagreement.mean_rad) / 2;
  return boundary * std::exp(-disagreement * disagreement);
}

/// Why there is nothing to measure; empty if there is.
std::string reason_against_picture(const SelectedCandidate& choice, const MeasureOptions& options,
                                   double confidence) {
  const Reading& best = choice.best;
  if (best.body.mask.empty()) {
    return "no heap stands out from the backdrop. Fix: use even light and a plain backdrop of a "
           "different colour from the grains, and show the ground on both sides of the heap.";
  }
  if (!best.has_flank()) {
    return fmt::format(
        "no sloping flank found (left: {}; right: {}). Fix: photograph a heap with at least one "
        "free "
        "flank and its foot in the frame.",
        best.left.reason.empty() ? "none" : best.left.reason,
        best.right.reason.empty() ? "none" : best.right.reason);
  }
  if (confidence < (choice.is_pointed_at ? kMinToldConfidence : kMinConfidence)) {
    return fmt::format(
        "the heap's edge is too uncertain (confidence {:.2f} of 1). Fix: use a plain backdrop of a "
        "different colour from the grains, even light and a sharp picture; exclude other objects "
        "with an {}.",
        confidence, base::field("excluded box"));
  }
  if (best.profile.leaves_frame_top && !options.hints.heap) {
    return "the crest is outside the picture, so the heap's height is unknown. Fix: step back or "
           "tilt the camera until the whole heap is in the frame.";
  }
  const double pitch = pitch_from_bow(best.body.ground.bow.value_or(0));
  if (!options.camera_pitch_rad && pitch > kLargestSeenPitch_rad) {
    return fmt::format(
        "the curved base implies that the camera looked down by about {:.0f} degrees, which "
        "changes the angle; or this is not a heap. Fix: retake the picture with a level camera at "
        "the heap's height, or give the {} if it is known.",
        to_degrees(pitch), base::field("camera pitch"));
  }
  if (best.grain && best.profile.crest_height < kFewestGrainsInHeight * *best.grain) {
    return "the object found is hardly higher than its grains: not a heap. Fix: photograph a heap "
           "at "
           "least 10 grains high.";
  }
  return {};
}

std::string reason_against_flanks(const Reading& best) {
  for (const Side side : {Side::left, Side::right}) {
    std::string reason = reason_against(best.flank(side), side);
    if (!reason.empty()) return reason;
  }
  return {};
}

/// Names all hints: without them the picture gives another number, or none.
void warn_of_hints(ReposeAngle& result, const MeasureOptions& options) {
  const Hints& hints = options.hints;
  if (hints.empty() && hints.source.empty()) return;
  const std::string what =
      hints.empty() ? "excluded boxes, pitch, board or camera file" : hints.text();
  const std::string where = hints.source.empty() ? "" : fmt::format(" in {}", hints.source);
  note(result, "hints", fmt::format("Hints given{}: {}.", where, what));
}

/// Why it may not be a heap; empty if the user has said that it is one.
std::string reason_to_doubt(const SelectedCandidate& choice, const MeasureOptions& options) {
  if (options.hints.heap || choice.is_pointed_at) return {};
  return reason_against_heap(choice.likeness, choice.best.grain);
}

void warn_of_likeness(ReposeAngle& result, const SelectedCandidate& choice,
                      const MeasureOptions& options) {
  const std::string reason = reason_to_doubt(choice, options);
  if (reason.empty()) return;
  flag(result, "unlike_a_heap",
       fmt::format("This may not be a heap, or not a heap alone: {}. If it is one, mark it with a "
                   "{} that leaves hands and rulers out.",
                   reason, base::field("heap box")));
  result.confidence = std::min(result.confidence, kMaxOfUnlike);
}

/// Whether a side is concave beyond what its grains explain.
bool is_hollow(const FlankFit& flank) {
  return flank.status == FlankStatus::ok && flank.bend_rad > 0 &&
         flank.sure_bend_rad() > kHollow_rad;
}

/// By how much the tangent at half height may vary by chance: two standard errors of a line over a
/// third of the window, which are 3^1.5 of the window's.
double tangent_chance_rad(const Reading& best) {
  constexpr double kThirdsPerWhole = 5.2, kByChance = 2;
  return kByChance * kThirdsPerWhole * std::max(best.left.fit_error_rad, best.right.fit_error_rad);
}

/// Adds the other common definitions if they lie outside the interval. A rounded crest and a toe
/// shift some of them on every heap; for a concave flank it is open which one is meant, unless one
/// was named.
void warn_of_definitions(ReposeAngle& result, const Reading& best, bool is_named) {
  const double angle = *result.angle_rad;
  double least = angle;
  double most = angle;
  double sure = 0;
  for (const NamedAngle& other : result.definitions) {
    least = std::min(least, other.angle_rad);
    most = std::max(most, other.angle_rad);
    const bool is_tangent = other.name == "half_height_tangent";
    const double chance = is_tangent ? tangent_chance_rad(best) : 0;
    sure = std::max(sure, std::abs(other.angle_rad - angle) - chance);
  }
  const double interval = *result.uncertainty_rad;
  if (std::max(most - angle, angle - least) <= interval) return;
  const bool is_open = !is_named && sure > interval + kFarApart_rad &&
                       (is_hollow(best.left) || is_hollow(best.right));
  const auto tell = is_open ? flag : note;
  tell(result, "definitions_differ",
       fmt::format("Other definitions of the angle give {:.1f} to {:.1f} degrees: state yours when "
                   "you publish.",
                   to_degrees(least), to_degrees(most)));
}

/// The sides by the definition in use.
struct ShownFlanks {
  const FlankFit& left;
  const FlankFit& right;
};

void warn_of_angle(ReposeAngle& result, const Reading& best, const ShownFlanks& shown,
                   bool is_named) {
  if (*result.uncertainty_rad > kWideInterval_rad) {
    const double apron_rad = std::max(shown.left.apron_rad, shown.right.apron_rad);
    const bool is_by_apron = apron_rad > *result.uncertainty_rad / 2;
    flag(result, "wide_interval",
         fmt::format("The angle is uncertain by ±{:.1f} degrees: {}.",
                     to_degrees(*result.uncertainty_rad),
                     is_by_apron ? "state whether the apron belongs to it, or make the heap on a "
                                   "base as wide as the heap alone"
                                 : "measure more pictures of this heap, or a heap of more grains"));
  }
  warn_of_definitions(result, best, is_named);
}

void warn_of_size(ReposeAngle& result, const Reading& best, const MeasureOptions& options) {
  if (best.profile.crest_height < kLowHeap_px) {
    flag(result, "low_heap",
         fmt::format("The heap is only {:.0f} pixels high: take the picture from closer up.",
                     best.profile.crest_height));
  }
  if (!best.grain) return;
  const double grains = best.profile.crest_height / *best.grain;
  const double steps = grains * (options.window_to - options.window_from);
  if (grains < kFewGrains || steps < kFewSteps) {
    note(result, "few_grains",
         fmt::format(
             "About {:.0f} grains high, {:.0f} in the window: single grains affect the angle.",
             grains, steps));
  }
}

/// A line inside a heap that is lit from one side is easily mistaken for its edge: heaps are not
/// that lopsided.
void warn_of_unequal_flanks(ReposeAngle& result) {
  if (!result.left.angle_rad || !result.right.angle_rad) return;
  const double difference = std::abs(*result.left.angle_rad - *result.right.angle_rad);
  if (difference <= kUnequal_rad) return;
  const double interval =
      std::hypot(result.left.uncertainty_rad.value_or(0), result.right.uncertainty_rad.value_or(0));
  const std::string what =
      fmt::format("The two flanks differ by {:.1f} degrees", to_degrees(difference));
  if (difference > kTooUnequal_rad && difference > interval) {
    flag(result, "unequal_flanks",
         what + ": check that the overlay follows the heap's edge on both.");
  } else {
    note(result, "unequal_flanks", what + ".");
  }
}

/// How far below the lens's axis the base is seen; 0 if the lens is unknown.
double below_axis_rad(const ReposeAngle& result, const MeasureOptions& options) {
  if (!options.pinhole || !result.ground) return 0;
  const double middle = (result.ground->from.y + result.ground->to.y) / 2;
  return std::atan((middle - options.pinhole->centre.y) / options.pinhole->focal_px);
}

/// Compares a given pitch with the one implied by the base.
void warn_of_pitch(ReposeAngle& result, const Ground& ground, const MeasureOptions& options) {
  const double given = *options.camera_pitch_rad;
  // The bow shows from how far above the base is seen: with a known lens, below its axis.
  const double below_axis = below_axis_rad(result, options);
  const double expected = given + below_axis;
  if (expected < -kPitchTolerance_rad) {
    flag(
        result, "pitch_disagrees",
        fmt::format("A camera that looks up by {:.0f} degrees does not see the plate that the heap "
                    "stands on. Give a downward pitch as a positive number.",
                    to_degrees(-given)));
    return;
  }
  if (!ground.bow) return;
  const double pitch = pitch_from_bow(*ground.bow);
  if (std::abs(pitch - std::max(0.0, expected)) <= kPitchTolerance_rad) return;
  flag(result, "pitch_disagrees",
       fmt::format("The curved base implies a pitch of {:.0f} degrees, not the {:.0f} given.",
                   to_degrees(pitch - below_axis), to_degrees(given)));
}

void warn_of_scene(ReposeAngle& result, const SelectedCandidate& choice,
                   const MeasureOptions& options) {
  const Reading& best = choice.best;
  const Ground& ground = best.body.ground;
  const double pitch = pitch_from_bow(ground.bow.value_or(0));
  if (!options.camera_pitch_rad && pitch > kDoubtfulPitch_rad) {
    flag(result, "base_bows",
         fmt::format(
             "The curved base implies that the camera looked down by about {:.0f} degrees; give "
             "the {} if it did.",
             to_degrees(pitch), base::field("camera pitch")));
  }
  if (options.camera_pitch_rad) warn_of_pitch(result, ground, options);
  if (std::abs(ground.tilt_rad()) > kTilted_rad) {
    note(result, "tilted_picture",
         fmt::format("The ground is tilted by {:.1f} degrees in the picture; angles are measured "
                     "from it.",
                     to_degrees(ground.tilt_rad())));
  }
  if (ground.behind) {
    flag(result, "edge_behind",
         "The line taken for the ground is an edge behind the heap, which extends below it: its "
         "foot is hidden. Use a plate of a different colour from the grains.");
  }
  if (ground.mirrored) {
    note(result, "mirror", "The ground line is the axis of the heap's reflection.");
  }
  if (result.loose_particles > 0) {
    note(result, "strays",
         fmt::format("{} small object{} beside the heap {} ignored.", result.loose_particles,
                     result.loose_particles == 1 ? "" : "s",
                     result.loose_particles == 1 ? "is" : "are"));
  }
}

}  // namespace

namespace {

/// By the requested definition; std::nullopt if the edge has no angle by it.
std::optional<ShownFlanks> shown_flanks(const SelectedCandidate& choice,
                                        const MeasureOptions& options) {
  if (base::is_usual_definition(options.definition)) {
    return ShownFlanks{choice.best.left, choice.best.right};
  }
  const SelectedFlanks* other = choice.by(options.definition);
  if (other == nullptr) return std::nullopt;
  return ShownFlanks{other->flanks.left, other->flanks.right};
}

}  // namespace

void judge(ReposeAngle& result, const SelectedCandidate& choice, const MeasureOptions& options) {
  result.status = MeasureStatus::ok;
  result.outline_valid = false;
  result.confidence = confidence_of(choice);
  if (std::string reason = reason_against_picture(choice, options, result.confidence);
      !reason.empty()) {
    refuse(result, std::move(reason));
    return;
  }
  if (std::string reason = reason_against_flanks(choice.best); !reason.empty()) {
    refuse(result, std::move(reason));
    result.outline_valid = reason_to_doubt(choice, options).empty();
    return;
  }
  const std::optional<ShownFlanks> shown = shown_flanks(choice, options);
  if (!shown) {
    refuse(result,
           fmt::format("there is no angle by {}: a foot is hidden, or too little of a flank "
                       "is seen. Fix: show the whole heap, larger, or measure by {}.",
                       options.definition, base::kUsualDefinition.name));
    result.outline_valid = true;
    return;
  }
  if (result.confidence < kDoubtfulConfidence) {
    flag(result, "weak_edge",
         fmt::format("The heap's edge is uncertain (confidence {:.2f} of 1): check the overlay.",
                     result.confidence));
  }
  warn_of_flank(result, choice.best, shown->left, Side::left);
  warn_of_flank(result, choice.best, shown->right, Side::right);
  if (choice.best.profile.leaves_frame_top) {
    flag(result, "crest_cut",
         "The box cuts off the crest: the heap's height is taken to end there.");
  }
  warn_of_hints(result, options);
  warn_of_likeness(result, choice, options);
  warn_of_angle(result, choice.best, *shown, !options.definition.empty());
  warn_of_size(result, choice.best, options);
  warn_of_scene(result, choice, options);
  warn_of_unequal_flanks(result);
}

}  // namespace repose::vision
