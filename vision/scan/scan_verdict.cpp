#include "vision/scan/scan_verdict.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/units.h"

namespace repose::vision {

namespace {

// As in vision/measure/verdict.cpp.
constexpr double kLevel_rad = 4 * kDegree;
constexpr double kUpright_rad = 65 * kDegree;
constexpr double kRound_rad = 17 * kDegree;
constexpr double kMostSpread_rad = 12 * kDegree;
constexpr double kLeastR2 = 0.85;
constexpr double kBent_rad = 10 * kDegree;
constexpr double kWide_rad = 5 * kDegree;
constexpr double kHollowFlank_rad = 3 * kDegree;
constexpr double kFarDefinition_rad = 3 * kDegree;

constexpr int kFewestSectors = 3;  // of eight: over less of a ring, a plane may be tilted
constexpr int kAllAround = 6;
constexpr double kMostHoles = 0.25;  // of the base
constexpr double kManyHoles = 0.05;
constexpr double kFewestAzimuths = 0.5;
constexpr double kManyUnseen = 0.1;
constexpr double kUneven_rad = 8 * kDegree;

int with_status(const Slices& slices, FlankStatus status) {
  return static_cast<int>(
      std::count_if(slices.all.begin(), slices.all.end(),
                    [&](const Slice& slice) { return slice.azimuth.status == status; }));
}

std::string why_few(const Slices& slices, int seen) {
  if (with_status(slices, FlankStatus::truncated) > kAzimuths / 4) {
    return fmt::format(
        "the scan's edge cuts the heap off: only {} of {} azimuths have a flank. "
        "Fix: scan the heap from all around, with ground on every side.",
        seen, kAzimuths);
  }
  const auto any = std::find_if(slices.all.begin(), slices.all.end(), [](const Slice& slice) {
    return slice.azimuth.status != FlankStatus::ok;
  });
  return fmt::format(
      "only {} of {} azimuths have a flank (elsewhere: {}). Fix: scan the heap from "
      "all around; check that it is one.",
      seen, kAzimuths, any->azimuth.reason);
}

/// Why the shape of the flanks is not that of a heap.
std::optional<std::string> shape_reason(const Slices& slices) {
  const double angle = *slices.mean();
  const double bend = slices.mean_of([](const FlankFit& fit) { return fit.bend_rad; });
  const double spread = slices.mean_of([](const FlankFit& fit) { return fit.window_spread_rad; });
  const double r2 = slices.mean_of([](const FlankFit& fit) { return fit.least_squares.r2; });
  if (angle < kLevel_rad) {
    return fmt::format(
        "the flanks are level ({:.1f} degrees): this is a layer, not a heap. Fix: scan "
        "a heap whose flanks end on the ground.",
        to_degrees(angle));
  }
  if (angle > kUpright_rad) {
    return fmt::format(
        "the flanks have a slope of {:.0f} degrees, too steep for loose grains. Fix: "
        "cut walls and tubes out of the scan.",
        to_degrees(angle));
  }
  if (bend < -kRound_rad) {
    return fmt::format(
        "the flanks are round, {:.0f} degrees flatter at the top than at the foot: no "
        "straight flanks. Fix: check that the scan shows a heap.",
        -to_degrees(bend));
  }
  if (spread > kMostSpread_rad) {
    return fmt::format(
        "the angle changes by {:.0f} degrees with the window: no straight flanks. Fix: "
        "check that the scan shows a heap alone.",
        to_degrees(spread));
  }
  if (r2 < kLeastR2) {
    return fmt::format(
        "the flanks are no lines (r2 {:.2f}). Fix: check that the scan shows a heap; "
        "scan it with less noise.",
        r2);
  }
  return std::nullopt;
}

void add_note(ScannedHeap& heap, std::string code, std::string message) {
  heap.angle.warnings.push_back({std::move(code), std::move(message)});
}

void add_flag(ScannedHeap& heap, std::string code, std::string message) {
  heap.angle.status = MeasureStatus::flagged;
  add_note(heap, std::move(code), std::move(message));
}

void warn_of_what_was_seen(const Slices& slices, int others, ScannedHeap& heap) {
  if (heap.points_left_out > 0) {
    add_note(heap, "points_left_out",
             fmt::format("{} points without a place were left out.", heap.points_left_out));
  }
  if (others > 0) {
    add_note(heap, "strays",
             fmt::format("{} smaller {} beside the heap {} left out.", others,
                         others == 1 ? "body" : "bodies", others == 1 ? "was" : "were"));
  }
  if (heap.ground && heap.ground->sectors < kAllAround) {
    add_flag(
        heap, "ground_one_sided",
        fmt::format("The ground is seen in {} of 8 sectors around the heap: it may lean towards "
                    "where it is not seen.",
                    heap.ground->sectors));
  }
  if (heap.hole_share > kManyHoles) {
    add_flag(heap, "holes",
             fmt::format("{:.0f} % of the heap's base were not seen, and are filled from around.",
                         100 * heap.hole_share));
  }
  const auto unseen = kAzimuths - static_cast<int>(slices.angles().size());
  if (unseen == 0) return;
  const std::string message = fmt::format(
      "{} of {} azimuths have no angle: the mean is that of the others.", unseen, kAzimuths);
  if (unseen > kManyUnseen * kAzimuths) {
    add_flag(heap, "azimuths_unseen", message);
  } else {
    add_note(heap, "azimuths_unseen", message);
  }
}

/// A plate, a disc or a dish no wider than the heap on it appears as a step at its foot.
void warn_of_step(const Slices& slices, ScannedHeap& heap) {
  constexpr double kShort = 0.85;  // of the run to where the flank's line meets the ground
  double reach = 0, run = 0;
  for (const Slice& slice : slices.all) {
    const LineFit& line = slice.fit.shown;
    if (!slice.azimuth.angle_rad || line.slope >= 0) continue;
    reach += slice.reach;
    run += -line.intercept / line.slope;
  }
  if (!(reach < kShort * run)) return;
  add_flag(
      heap, "step_at_foot",
      fmt::format("The heap ends {:.0f} % short of where its flanks' line meets the ground, as "
                  "on a plate no wider than itself, which then counts in height and volume: "
                  "give three points of what it stands on as {}.",
                  100 * (1 - reach / run), base::field("ground plane")));
}

/// A disc wider than the heap, or a hollow in which it stands.
void warn_of_ledge(std::optional<double> ledge, ScannedHeap& heap) {
  if (!ledge) return;
  add_flag(
      heap, "ledge_at_foot",
      fmt::format(
          "Around the foot lies a level ledge, {:.0f} % of the heap's height {} the ground, as "
          "of {}, so that volume, height and base are not the heap's: give three points of "
          "what it stands on as {}.",
          100 * std::abs(*ledge), *ledge > 0 ? "above" : "below",
          *ledge > 0 ? "a disc or a tray that it stands on" : "a hollow that it stands in",
          base::field("ground plane")));
}

/// Sizes that no scanned heap has: the unit must be another.
void warn_of_size(ScannedHeap& heap) {
  constexpr double kSmallest_mm = 1, kLargest_mm = 200e3;  // across
  if (!heap.base_mm) return;
  const double base_mm = heap.base_mm->value;
  if (base_mm >= kSmallest_mm && base_mm <= kLargest_mm) return;
  add_flag(
      heap, "unlikely_size",
      fmt::format("The heap's base is {:.3g} mm across. If it is not, the file has another unit "
                  "({}, say): correct the {}.",
                  base_mm, base_mm < kSmallest_mm ? "metres" : "millimetres", base::field("unit")));
}

void warn_of_definitions(double bend_rad, ScannedHeap& heap) {
  const double angle = *heap.angle.angle_rad, interval = *heap.angle.uncertainty_rad;
  double low = angle, high = angle;
  for (const NamedAngle& definition : heap.angle.definitions) {
    low = std::min(low, definition.angle_rad);
    high = std::max(high, definition.angle_rad);
  }
  const double farthest = std::max(angle - low, high - angle) - interval;
  if (farthest <= 0) return;
  const std::string message = fmt::format(
      "Other definitions of the angle give {:.1f} to {:.1f} degrees: state yours when "
      "you publish.",
      to_degrees(low), to_degrees(high));
  if (bend_rad > kHollowFlank_rad && farthest > kFarDefinition_rad) {
    add_flag(heap, "definitions_differ", message);
  } else {
    add_note(heap, "definitions_differ", message);
  }
}

}  // namespace

std::string few_points_reason(std::size_t points) {
  return fmt::format(
      "there are too few points ({}) for a heap's flanks. Fix: scan from nearer, or "
      "export the scan without thinning it out.",
      points);
}

std::optional<std::string> reason_against(const Slices& slices, const ScannedHeap& heap) {
  if (heap.ground && heap.ground->sectors < kFewestSectors) {
    return fmt::format(
        "there is hardly any ground around the heap. Fix: scan the plate around it, "
        "too, a third of the heap's width on every side.");
  }
  if (heap.hole_share > kMostHoles) {
    return fmt::format(
        "{:.0f} % of the heap's base were not seen: the holes are too large. Fix: scan "
        "it from all around, and from above.",
        100 * heap.hole_share);
  }
  const auto seen = static_cast<int>(slices.angles().size());
  if (seen < kFewestAzimuths * kAzimuths) return why_few(slices, seen);
  return shape_reason(slices);
}

void warn_of_scan(const Slices& slices, int others, std::optional<double> ledge,
                  ScannedHeap& heap) {
  warn_of_what_was_seen(slices, others, heap);
  warn_of_step(slices, heap);
  warn_of_ledge(ledge, heap);
  warn_of_size(heap);
  const double bend = slices.mean_of([](const FlankFit& fit) { return fit.bend_rad; });
  const double apron = slices.mean_of([](const FlankFit& fit) { return fit.apron_rad; });
  constexpr double kSeenApron_rad = 0.1 * kDegree;
  if (apron > kSeenApron_rad) {
    add_note(heap, "apron_left_out",
             fmt::format("Parts of the foot are aprons, much flatter than the flank above, and "
                         "hardly count: if they counted in full, the mean would change by {:.1f} "
                         "degrees; the interval covers that.",
                         to_degrees(apron)));
  }
  if (std::abs(bend) > kBent_rad) {
    add_flag(heap, "bent_flank",
             fmt::format("The flanks are {}: their slope differs by {:.0f} degrees between their "
                         "lower and upper half, so one angle does not describe them.",
                         bend > 0 ? "concave" : "convex", std::abs(to_degrees(bend))));
  }
  if (heap.azimuth_sd_rad && *heap.azimuth_sd_rad > kUneven_rad) {
    add_flag(
        heap, "uneven_azimuths",
        fmt::format("The angle differs between azimuths by {:.1f} degrees (standard deviation): "
                    "this may not be a heap, or one against a wall.",
                    to_degrees(*heap.azimuth_sd_rad)));
  }
  if (*heap.angle.uncertainty_rad > kWide_rad) {
    add_flag(heap, "wide_interval",
             fmt::format("The angle is uncertain by {:.1f} degrees.",
                         to_degrees(*heap.angle.uncertainty_rad)));
  }
  warn_of_definitions(bend, heap);
}

}  // namespace repose::vision
