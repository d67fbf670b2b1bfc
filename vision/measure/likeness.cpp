#include "vision/measure/likeness.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace repose::vision {

LightSteps light_steps(const cv::Mat1f& lightness, const cv::Mat1b& inside) {
  constexpr float kNone = 0.05F;
  double sum = 0;
  int even = 0;
  int pairs = 0;
  for (int row = 0; row < inside.rows; row += 2) {
    for (int col = 0; col + 1 < inside.cols; col += 2) {
      if (inside(row, col) == 0 || inside(row, col + 1) == 0) continue;
      const float step = std::abs(lightness(row, col + 1) - lightness(row, col));
      sum += step;
      even += step < kNone ? 1 : 0;
      ++pairs;
    }
  }
  return {.mean = sum / std::max(1, pairs), .even = static_cast<double>(even) / std::max(1, pairs)};
}

namespace {

constexpr int kRim_px = 5;               // of the body, whose own edge is not an edge inside it
constexpr double kUpright = 3.7;         // tan 75 degrees: edges this steep are walls and rulers
constexpr double kPatchBlur = 1.0 / 14;  // of the crest's height
constexpr double kPatchStep = 1.0 / 10;  // ... over which the colour must not change
constexpr double kCoarser = 4;           // picture pixels per compared pixel
constexpr double kPatchChange = 9;       // distance in L*a*b* between different parts
constexpr double kGradientBlur_px = 1;   // single pixels have no direction
constexpr float kFaintestGradient = 1e-3F;
constexpr std::size_t kRings = 32;  // of wavelengths
constexpr double kStrong = 8;       // times the mean of the ring: probability one in 3000

/// The part of the picture inside the body's box.
struct Inside {
  cv::Mat1b core;  ///< the body without its rim
  cv::Mat3f lab;
  cv::Mat1f lightness;
  cv::Mat3b bgr;
};

Inside inside_of(const cv::Mat1b& body, const WorkingPicture& work) {
  const cv::Rect box = cv::boundingRect(body);
  Inside inside;
  cv::erode(body(box), inside.core,
            cv::getStructuringElement(cv::MORPH_RECT, {2 * kRim_px + 1, 2 * kRim_px + 1}), {-1, -1},
            1, cv::BORDER_CONSTANT, 0);
  inside.lab = work.lab(box);
  inside.bgr = work.bgr(box);
  return inside;
}

/// Whether there are pixels inside, and all have one colour.
bool is_flat(const Inside& inside) {
  const cv::Vec3b* first = nullptr;
  for (int row = 0; row < inside.bgr.rows; ++row) {
    for (int col = 0; col < inside.bgr.cols; ++col) {
      if (inside.core(row, col) == 0) continue;
      if (first == nullptr) first = &inside.bgr(row, col);
      if (inside.bgr(row, col) != *first) return false;
    }
  }
  return first != nullptr;
}

double longest_edge_in(const Inside& inside) {
  cv::Mat1b grey;
  cv::cvtColor(inside.bgr, grey, cv::COLOR_BGR2GRAY);
  std::vector<cv::Vec4f> segments;
  cv::createLineSegmentDetector(cv::LSD_REFINE_STD)->detect(grey, segments);
  double longest = 0;
  for (const cv::Vec4f& s : segments) {
    const cv::Point middle(static_cast<int>((s[0] + s[2]) / 2),
                           static_cast<int>((s[1] + s[3]) / 2));
    if (!cv::Rect({}, inside.core.size()).contains(middle) || inside.core(middle) == 0) continue;
    if (std::abs(s[3] - s[1]) > kUpright * std::abs(s[2] - s[0])) continue;
    longest = std::max<double>(longest, std::hypot(s[2] - s[0], s[3] - s[1]));
  }
  return longest;
}

double distance(const cv::Vec3f& a, const cv::Vec3f& b) { return cv::norm(a - b); }

double patchy_part(const Inside& inside, double crest_height) {
  const double height = crest_height / kCoarser;
  cv::Mat3f sharp = inside.lab.clone();
  sharp.setTo(cv::Scalar::all(0), ~inside.core);
  cv::Mat1f sharp_weight;
  inside.core.convertTo(sharp_weight, CV_32F, 1 / 255.0);
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

/// Magnitudes of the means of exp(2 i a) and exp(4 i a), where a is the direction of the gradients,
/// weighted by their lengths: 0 if they point in all directions, as around grains.
void add_directions(BodyTexture& texture, const Inside& inside) {
  cv::Mat1f smooth;
  cv::GaussianBlur(inside.lightness, smooth, {}, kGradientBlur_px);
  cv::Mat1f across;
  cv::Mat1f down;
  cv::Scharr(smooth, across, CV_32F, 1, 0);
  cv::Scharr(smooth, down, CV_32F, 0, 1);
  double lengths = 0;
  cv::Vec2d twice;
  cv::Vec2d four_times;
  for (int row = 0; row < inside.core.rows; ++row) {
    for (int col = 0; col < inside.core.cols; ++col) {
      const double x = across(row, col);
      const double y = down(row, col);
      const double length = std::sqrt(x * x + y * y);
      if (inside.core(row, col) == 0 || length < kFaintestGradient) continue;
      const double cos2 = (x * x - y * y) / (length * length);
      const double sin2 = 2 * x * y / (length * length);
      lengths += length;
      twice += length * cv::Vec2d(cos2, sin2);
      four_times += length * cv::Vec2d(cos2 * cos2 - sin2 * sin2, 2 * cos2 * sin2);
    }
  }
  if (lengths == 0) return;
  texture.aligned = cv::norm(twice) / lengths;
  texture.crossed = cv::norm(four_times) / lengths;
}

/// Power spectrum of the pattern.
cv::Mat1f spectrum_of(const Inside& inside) {
  cv::Mat1f weight;
  inside.core.convertTo(weight, CV_32F, 1 / 255.0);
  const double coarse_px = std::max(2.0, inside.core.rows / 8.0);
  cv::Mat1f sum;
  cv::Mat1f count;
  cv::GaussianBlur(inside.lightness.mul(weight), sum, {}, coarse_px);
  cv::GaussianBlur(weight, count, {}, coarse_px);
  const cv::Mat1f pattern = (inside.lightness - sum / (count + 1e-6)).mul(weight);
  cv::Mat1f padded;
  cv::copyMakeBorder(pattern, padded, 0, cv::getOptimalDFTSize(pattern.rows) - pattern.rows, 0,
                     cv::getOptimalDFTSize(pattern.cols) - pattern.cols, cv::BORDER_CONSTANT, 0);
  cv::Mat2f waves;
  cv::dft(padded, waves, cv::DFT_COMPLEX_OUTPUT);
  std::vector<cv::Mat1f> parts;
  cv::split(waves, parts);
  return parts[0].mul(parts[0]) + parts[1].mul(parts[1]);
}

/// Fraction of the pattern's power in waves that are much stronger than others of similar length:
/// randomly packed grains have none; laid or woven things have little else.
double regular_part(const Inside& inside) {
  const cv::Mat1f power = spectrum_of(inside);
  std::vector<double> sum(kRings, 0);
  std::vector<int> count(kRings, 0);
  const auto ring_of = [&](int row, int col) {
    const double down = static_cast<double>(std::min(row, power.rows - row)) / power.rows;
    const double across = static_cast<double>(std::min(col, power.cols - col)) / power.cols;
    return static_cast<std::size_t>(2 * kRings * std::hypot(down, across));
  };
  double all = 0;
  for (int row = 0; row < power.rows; ++row) {
    for (int col = 0; col < power.cols; ++col) {
      const std::size_t ring = ring_of(row, col);
      if (ring >= kRings) continue;  // in the corners: shorter than two pixels
      sum[ring] += power(row, col);
      ++count[ring];
      all += power(row, col);
    }
  }
  if (all <= 0) return 0;
  double strong = 0;
  for (int row = 0; row < power.rows; ++row) {
    for (int col = 0; col < power.cols; ++col) {
      const std::size_t ring = ring_of(row, col);
      if (ring >= kRings) continue;
      strong += power(row, col) > kStrong * sum[ring] / count[ring] ? power(row, col) : 0;
    }
  }
  return strong / all;
}

}  // namespace

BodyTexture texture_of(const cv::Mat1b& body, double crest_height, const WorkingPicture& work) {
  Inside inside = inside_of(body, work);
  if (is_flat(inside)) return {.noise = 0, .even = 1};
  cv::extractChannel(inside.lab, inside.lightness, 0);
  const LightSteps steps = light_steps(inside.lightness, inside.core);
  BodyTexture texture{.noise = steps.mean, .even = steps.even};
  texture.straight = longest_edge_in(inside) / std::max(1.0, crest_height);
  texture.patchy = patchy_part(inside, crest_height);
  if (steps.is_silhouette()) return texture;
  texture.regular = regular_part(inside);
  add_directions(texture, inside);
  return texture;
}

namespace {

constexpr std::size_t kSmoothingParts =
    30;                                    // of the profile: narrower bumps do not count as a climb
constexpr double kSmoothingGrains = 3;     // nor do bumps narrower than that
constexpr double kLowest = 0.06;           // of the height: below, toes of grains leave gaps
constexpr std::size_t kRoughness_px = 25;  // over which the edge is averaged: several fine grains
constexpr std::size_t kTread_px = 5;       // over which a level edge is detected
constexpr double kLevelSlope = 0.15;       // of the flank's slope

/// A grain's size, from the body's pattern, or else from the edge's bumps.
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

/// Total rise of the smoothed edge from the crest outwards, over the crest's height, on the side
/// where it is larger; only on flanks, if there are any.
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

/// Fraction of the edge that is level compared with the flank's own slope: treads of stairs.
double level_part(const FlankFit& flank) {
  if (flank.status != FlankStatus::ok || flank.height.size() <= kTread_px) return 0;
  const double fall = kTread_px * std::abs(flank.robust.slope);
  int level = 0;
  for (std::size_t i = kTread_px; i < flank.height.size(); ++i) {
    level += std::abs(flank.height[i] - flank.height[i - kTread_px]) < kLevelSlope * fall ? 1 : 0;
  }
  return static_cast<double>(level) / static_cast<double>(flank.height.size() - kTread_px);
}

constexpr double kMinFilled = 0.93;
constexpr double kMaxClimb = 0.08;
constexpr double kLongestStraight = 0.4;
constexpr double kMaxPatchy = 0.12;
constexpr double kMaxAligned = 0.4;
constexpr double kMaxCrossed = 0.15;
constexpr double kMaxRegular = 0.33;
constexpr double kMaxLevel = 0.5;
constexpr double kMinNoise = 0.4;
// Roughness of an edge not made of grains [working px]: as a fraction of the grain size, for sharp
// and blurred edges, and in absolute terms.
constexpr double kSmoothGrain = 0.04;
constexpr double kSmoothFineGrain = 0.02;  // smoothed by the pixels
constexpr double kFineGrain_px = 5;
constexpr double kBlurredGrain = 0.015;
constexpr double kBlurred = 0.6;  // sharpness below which an edge is blurred
constexpr double kSharpEdge_px = 0.1;

/// Roughness below which an edge is smoother than grains make it [working px].
double least_roughness(const HeapPlausibility& likeness, std::optional<double> grain) {
  if (!grain) return kSharpEdge_px;
  const double of_grain = likeness.sharpness < kBlurred ? kBlurredGrain
                          : *grain < kFineGrain_px      ? kSmoothFineGrain
                                                        : kSmoothGrain;
  return std::max(kSharpEdge_px, of_grain * *grain);
}

std::string reason_of_shape(const HeapPlausibility& likeness) {
  if (likeness.filled < kMinFilled) {
    return fmt::format(
        "{:.0f} % of the area under its edge does not belong to it, as with a hand, legs, wheels "
        "and branches",
        100 * (1 - likeness.filled));
  }
  if (likeness.climb > kMaxClimb) {
    return fmt::format("its edge rises again by {:.0f} % of the height on the way down",
                       100 * likeness.climb);
  }
  if (likeness.level > kMaxLevel) {
    return fmt::format("{:.0f} % of its edge is level, as on stairs", 100 * likeness.level);
  }
  return {};
}

std::string reason_of_texture(const BodyTexture& inside, bool has_grains) {
  if (inside.straight > kLongestStraight) {
    return fmt::format(
        "it has a straight edge inside, {:.1f} times as long as it is high, as of "
        "a ruler, an arm or a box",
        inside.straight);
  }
  if (inside.patchy > kMaxPatchy) {
    return fmt::format(
        "it has parts of different colours ({:.0f} % of it lies between them), as "
        "with a hand or a ruler at its side",
        100 * inside.patchy);
  }
  if (inside.is_silhouette()) return {};
  if (inside.aligned > kMaxAligned || inside.crossed > kMaxCrossed) {
    return "its pattern runs in straight lines, as on boards, bricks, tiles and cloth";
  }
  if (inside.regular > kMaxRegular) {
    return fmt::format("{:.0f} % of its pattern repeats, as on tiles and cloth",
                       100 * inside.regular);
  }
  if (!has_grains || inside.noise < kMinNoise) {
    return "it shows no grains, and is not a silhouette";
  }
  return {};
}

}  // namespace

HeapPlausibility likeness_of(const Reading& reading, const WorkingPicture& work) {
  return {.filled = filled_part(reading, work),
          .climb = climb_of(reading),
          .rough_px = std::max(roughness_of(reading.left), roughness_of(reading.right)),
          .level = std::max(level_part(reading.left), level_part(reading.right)),
          .sharpness = reading.edge_sharpness,
          .inside = texture_of(reading.body.mask, reading.profile.crest_height, work)};
}

std::string reason_against_heap(const HeapPlausibility& likeness, std::optional<double> grain) {
  std::string reason = reason_of_shape(likeness);
  if (reason.empty()) reason = reason_of_texture(likeness.inside, grain.has_value());
  if (reason.empty() && likeness.rough_px < least_roughness(likeness, grain)) {
    reason = "its edge is smoother than that of grains";
  }
  return reason;
}

}  // namespace repose::vision
