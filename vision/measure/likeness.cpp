#include "vision/measure/likeness.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
namespace repose::vision {
namespace {

constexpr std::size_t kSmoothingParts =
    30;                                    // of the profile: bumps narrower than that are no climb
constexpr double kSmoothingGrains = 3;     // nor those narrower than that
constexpr double kLowest = 0.06;           // of the height: below, toes of grains leave gaps
constexpr std::size_t kRoughness_px = 25;  // over which the edge is averaged: several fine grains
constexpr std::size_t kTread_px = 5;       // over which a level edge is looked for
constexpr double kLevelSlope = 0.15;       // of the flank's slope

/// A grain's size, from the body's pattern or else from the edge's bumps.
double grain_of(const Reading& reading) {
  if (reading.grain) return *reading.grain;
  return std::max(reading.left.grain, reading.right.grain);
}

double filled_part(const Reading& reading, const WorkingPicture& work) {
  const cv::Mat1b& mask = reading.body.mask;
  const double gaps = std::max(kLowest * reading.profile.crest_height, grain_of(reading));
  double under = 0;
  double inside = 0;
  for (int col = 0; col < mask.cols; ++col) {
    const int level = std::clamp(
        static_cast<int>(std::lround(reading.body.ground.y(col + 0.5) - gaps)), 0, mask.rows);
    bool is_under = false;
    for (int row = 0; row < level; ++row) {
      const bool is_inside = mask(row, col) != 0;
      is_under = is_under || is_inside;
      if (!is_under || work.valid_mask(row, col) == 0) continue;
      under += 1;
      inside += is_inside ? 1 : 0;
    }
  }
  return under > 0 ? inside / under : 0;
}

/// Sum of all rises of the smoothed edge from the crest outwards, on the sides that are flanks.
double climb_of(const Reading& reading) {
  const Profile& profile = reading.profile;
  const double grain = grain_of(reading);
  const auto grains = static_cast<std::size_t>(kSmoothingGrains * grain);
  const std::vector<double> smooth = moving_average(
      profile.height, std::max({std::size_t{3}, grains, profile.size() / kSmoothingParts}));
  double left = 0;
  for (std::size_t i = profile.crest; i > 0; --i) left += std::max(0.0, smooth[i - 1] - smooth[i]);
  double right = 0;
  for (std::size_t i = profile.crest + 1; i < smooth.size(); ++i) {
    right += std::max(0.0, smooth[i] - smooth[i - 1]);
  }
  if (reading.left.status != FlankStatus::ok && reading.right.status == FlankStatus::ok) left = 0;
  if (reading.right.status != FlankStatus::ok && reading.left.status == FlankStatus::ok) right = 0;
  return std::max(left, right) / std::max(1.0, profile.crest_height);
}

double roughness_of(const FlankFit& flank) {
  if (flank.status != FlankStatus::ok) return 0;
  const std::vector<double> smooth = moving_average(flank.height, kRoughness_px);
  double squares = 0;
  for (std::size_t i = 0; i < smooth.size(); ++i) {
    squares += (flank.height[i] - smooth[i]) * (flank.height[i] - smooth[i]);
  }
  return std::sqrt(squares / std::max<double>(1, static_cast<double>(smooth.size())));
}

/// Part of the edge that is level, seen against the flank's own slope: treads of stairs.
double level_part(const FlankFit& flank) {
  if (flank.status != FlankStatus::ok || flank.height.size() <= kTread_px) return 0;
  const double fall = kTread_px * std::abs(flank.robust.slope);
  int level = 0;
  for (std::size_t i = kTread_px; i < flank.height.size(); ++i) {
    level += std::abs(flank.height[i] - flank.height[i - kTread_px]) < kLevelSlope * fall ? 1 : 0;
  }
  return static_cast<double>(level) / static_cast<double>(flank.height.size() - kTread_px);
}

constexpr double kLeastFilled = 0.93;
constexpr double kMostClimb = 0.08;
constexpr double kLongestStraight = 0.4;
constexpr double kMostPatchy = 0.12;
constexpr double kMostAligned = 0.4;
constexpr double kMostCrossed = 0.15;
constexpr double kMostRegular = 0.33;
constexpr double kMostLevel = 0.5;
constexpr double kLeastNoise = 0.4;
// Roughness of an edge that no grains make [working px]: of grains of some size, where the edge is
// sharp or blurred, and at all.
constexpr double kSmoothGrain = 0.04;
constexpr double kSmoothFineGrain = 0.02;  // the pixels smooth it
constexpr double kFineGrain_px = 5;
constexpr double kBlurredGrain = 0.015;
constexpr double kBlurred = 0.6;  // sharpness below which it is
constexpr double kSharpEdge_px = 0.1;

/// Below it an edge is smoother than grains make it [working px].
double least_roughness(const Likeness& likeness, std::optional<double> grain) {
  if (!grain) return kSharpEdge_px;
  const double of_grain = likeness.sharpness < kBlurred ? kBlurredGrain
                          : *grain < kFineGrain_px      ? kSmoothFineGrain
                                                        : kSmoothGrain;
  return std::max(kSharpEdge_px, of_grain * *grain);
}

std::string reason_of_shape(const Likeness& likeness) {
  if (likeness.filled < kLeastFilled) {
    return fmt::format(
        "{:.0f} % of the area under its edge does not belong to it, as with legs, "
        "wheels and branches",
        100 * (1 - likeness.filled));
  }
  if (likeness.climb > kMostClimb) {
    return fmt::format("its edge rises again by {:.0f} % of the height on the way down",
                       100 * likeness.climb);
  }
  if (likeness.level > kMostLevel) {
    return fmt::format("{:.0f} % of its edge is level, as on stairs", 100 * likeness.level);
  }
  return {};
}

std::string reason_of_texture(const BodyTexture& inside, bool has_grains) {
  if (inside.straight > kLongestStraight) {
    return fmt::format("it has a straight edge inside, {:.1f} times as long as it is high",
                       inside.straight);
  }
  if (inside.patchy > kMostPatchy) {
    return fmt::format("it has parts of different colours ({:.0f} % of it lies between them)",
                       100 * inside.patchy);
  }
  if (inside.is_silhouette()) return {};
  if (inside.aligned > kMostAligned || inside.crossed > kMostCrossed) {
    return "its pattern runs in straight lines, as on boards, bricks, tiles and cloth";
  }
  if (inside.regular > kMostRegular) {
    return fmt::format("{:.0f} % of its pattern repeats, as on tiles and cloth",
                       100 * inside.regular);
  }
  if (!has_grains || inside.noise < kLeastNoise) {
    return "it shows no grains, and is not a silhouette";
  }
  return {};
}

}  // namespace

Likeness likeness_of(const Reading& reading, const WorkingPicture& work) {
  return {.filled = filled_part(reading, work),
          .climb = climb_of(reading),
          .rough_px = std::max(roughness_of(reading.left), roughness_of(reading.right)),
          .level = std::max(level_part(reading.left), level_part(reading.right)),
          .sharpness = reading.edge_sharpness,
          .inside = texture_of(reading.body.mask, reading.profile.crest_height, work)};
}

std::string reason_against_heap(const Likeness& likeness, std::optional<double> grain) {
  std::string reason = reason_of_shape(likeness);
  if (reason.empty()) reason = reason_of_texture(likeness.inside, grain.has_value());
  if (reason.empty() && likeness.rough_px < least_roughness(likeness, grain)) {
    reason = "its edge is smoother than that of grains";
  }
  return reason;
}

}  // namespace repose::vision
