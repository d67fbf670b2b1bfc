#include "vision/measure/likeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace repose::vision {
namespace {

constexpr std::size_t kSmoothingParts =
    30;                                    // of the profile: bumps narrower than that are no climb
constexpr double kSmoothingGrains = 3;     // nor those narrower than that
constexpr double kLowest = 0.06;           // of the height: below, toes of grains leave gaps
constexpr double kUpright = 3.7;           // tan 75 degrees: edges so steep are walls and rulers
constexpr std::size_t kRoughness_px = 25;  // over which the edge is averaged: several fine grains
constexpr int kRim_px = 5;                 // of the body, whose own edge is no edge inside it
constexpr double kPatchBlur = 1.0 / 14;    // of the crest's height
constexpr double kPatchStep = 1.0 / 10;    // ... over which the colour may not change
constexpr double kCoarser = 4;             // pixels of the picture in one that is compared
constexpr double kPatchChange = 9;         // distance in L*a*b* that is another part

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

/// The body without its rim.
cv::Mat1b core_of(const cv::Mat1b& body, int rim) {
  cv::Mat1b core;
  cv::erode(body, core, cv::getStructuringElement(cv::MORPH_RECT, {2 * rim + 1, 2 * rim + 1}),
            {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  return core;
}

double noise_inside(const Reading& reading, const WorkingPicture& work) {
  const cv::Mat1b core = core_of(reading.body.mask, kRim_px);
  double sum = 0;
  int pairs = 0;
  for (int row = 0; row < core.rows; row += 2) {
    for (int col = 0; col + 1 < core.cols; col += 2) {
      if (core(row, col) == 0 || core(row, col + 1) == 0) continue;
      sum += std::abs(work.lab(row, col + 1)[0] - work.lab(row, col)[0]);
      ++pairs;
    }
  }
  return pairs > 0 ? sum / pairs : 0;
}

double longest_edge_inside(const Reading& reading, const WorkingPicture& work) {
  const cv::Rect box = cv::boundingRect(reading.body.mask);
  const cv::Mat1b core = core_of(reading.body.mask, kRim_px)(box);
  cv::Mat1b grey;
  cv::cvtColor(work.bgr(box), grey, cv::COLOR_BGR2GRAY);
  std::vector<cv::Vec4f> segments;
  cv::createLineSegmentDetector(cv::LSD_REFINE_STD)->detect(grey, segments);
  double longest = 0;
  for (const cv::Vec4f& s : segments) {
    const cv::Point middle(static_cast<int>((s[0] + s[2]) / 2),
                           static_cast<int>((s[1] + s[3]) / 2));
    if (!cv::Rect({}, core.size()).contains(middle) || core(middle) == 0) continue;
    if (std::abs(s[3] - s[1]) > kUpright * std::abs(s[2] - s[0])) continue;
    longest = std::max<double>(longest, std::hypot(s[2] - s[0], s[3] - s[1]));
  }
  return longest / std::max(1.0, reading.profile.crest_height);
}

double distance(const cv::Vec3f& a, const cv::Vec3f& b) { return cv::norm(a - b); }

double patchy_part(const Reading& reading, const WorkingPicture& work) {
  const double height = reading.profile.crest_height / kCoarser;
  const cv::Rect box = cv::boundingRect(reading.body.mask);
  const cv::Mat1b sharp_core = core_of(reading.body.mask, kRim_px)(box);
  cv::Mat3f sharp = work.lab(box).clone();
  sharp.setTo(cv::Scalar::all(0), ~sharp_core);
  cv::Mat1f sharp_weight;
  sharp_core.convertTo(sharp_weight, CV_32F, 1 / 255.0);
  cv::Mat3f colour;
  cv::Mat1f weight;
  cv::resize(sharp, colour, {}, 1 / kCoarser, 1 / kCoarser, cv::INTER_AREA);
  cv::resize(sharp_weight, weight, {}, 1 / kCoarser, 1 / kCoarser, cv::INTER_AREA);
  const cv::Mat1b core = weight > 0.5;
  cv::GaussianBlur(colour, colour, {}, std::max(0.5, kPatchBlur * height));
  cv::GaussianBlur(weight, weight, {}, std::max(0.5, kPatchBlur * height));
  const int step = std::max(1, static_cast<int>(kPatchStep * height));
  int pairs = 0;
  int changed = 0;
  for (const cv::Point shift : {cv::Point(step, 0), cv::Point(0, step)}) {
    for (int row = 0; row + shift.y < core.rows; ++row) {
      for (int col = 0; col + shift.x < core.cols; ++col) {
        const cv::Point here(col, row);
        const cv::Point there = here + shift;
        if (core(here) == 0 || core(there) == 0) continue;
        ++pairs;
        const cv::Vec3f before = colour(here) / weight(here);
        changed += distance(before, colour(there) / weight(there)) > kPatchChange ? 1 : 0;
      }
    }
  }
  return pairs > 0 ? static_cast<double>(changed) / pairs : 0;
}

constexpr double kLeastFilled = 0.93;
constexpr double kMostClimb = 0.08;
constexpr double kLongestStraight = 0.4;
constexpr double kMostPatchy = 0.1;
// Roughness of an edge that no grains make: without a pattern on the body of a photograph, with one
// of grains of some size, and at all [working px].
constexpr double kSmoothEdge_px = 0.3;
constexpr double kSmoothGrain = 0.03;
constexpr double kBlurredGrain = 0.015;  // ... of the grain, where the edge is less sharp than
constexpr double kBlurred = 0.65;
constexpr double kSharpEdge_px = 0.1;
constexpr double kNoNoise =
    0.05;  // of lightness, from pixel to pixel: a camera's is ten times that

/// Below it an edge is smoother than grains make it.
double least_roughness(const Likeness& likeness, std::optional<double> grain) {
  if (!grain) return likeness.noise < kNoNoise ? kSharpEdge_px : kSmoothEdge_px;
  const double of_grain = likeness.sharpness < kBlurred ? kBlurredGrain : kSmoothGrain;
  return std::max(kSharpEdge_px, of_grain * *grain);
}

}  // namespace

Likeness likeness_of(const Reading& reading, const WorkingPicture& work) {
  return {.filled = filled_part(reading, work),
          .climb = climb_of(reading),
          .straight = longest_edge_inside(reading, work),
          .rough_px = std::max(roughness_of(reading.left), roughness_of(reading.right)),
          .noise = noise_inside(reading, work),
          .sharpness = reading.edge_sharpness,
          .patchy = patchy_part(reading, work)};
}

std::string reason_against_heap(const Likeness& likeness, std::optional<double> grain) {
  if (likeness.filled < kLeastFilled) {
    return fmt::format(
        "{:.0f} % of what lies under its edge is not its own, as under legs, wheels "
        "and branches",
        100 * (1 - likeness.filled));
  }
  if (likeness.climb > kMostClimb) {
    return fmt::format("on its way down its edge rises again by {:.0f} % of the height",
                       100 * likeness.climb);
  }
  if (likeness.straight > kLongestStraight) {
    return fmt::format("it has a straight edge inside that is {:.1f} times as long as it is high",
                       likeness.straight);
  }
  if (likeness.patchy > kMostPatchy) {
    return fmt::format("it has parts of different colours ({:.0f} % of it lies between them)",
                       100 * likeness.patchy);
  }
  if (likeness.rough_px < least_roughness(likeness, grain)) {
    return "its edge is as smooth as no edge of grains is";
  }
  return {};
}

}  // namespace repose::vision
