#include "vision/measure/likeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace repose::vision {
namespace {

constexpr std::size_t kSmoothingParts =
    30;                                  // of the profile: bumps narrower than that are no climb
constexpr int kRim_px = 5;               // of the body, whose own edge is no edge inside it
constexpr double kPatchBlur = 1.0 / 14;  // of the crest's height
constexpr double kPatchStep = 1.0 / 10;  // ... over which the colour may not change
constexpr double kPatchChange = 9;       // distance in L*a*b* that is another part

double filled_part(const Reading& reading, const WorkingPicture& work) {
  const cv::Mat1b& mask = reading.body.mask;
  double under = 0;
  double inside = 0;
  for (int col = 0; col < mask.cols; ++col) {
    const int level =
        std::clamp(static_cast<int>(std::lround(reading.body.ground.y(col + 0.5))), 0, mask.rows);
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

/// Sum of all rises of the smoothed edge from the crest outwards.
double climb_of(const Profile& profile) {
  const std::vector<double> smooth =
      moving_average(profile.height, std::max<std::size_t>(3, profile.size() / kSmoothingParts));
  double left = 0;
  for (std::size_t i = profile.crest; i > 0; --i) left += std::max(0.0, smooth[i - 1] - smooth[i]);
  double right = 0;
  for (std::size_t i = profile.crest + 1; i < smooth.size(); ++i) {
    right += std::max(0.0, smooth[i] - smooth[i - 1]);
  }
  return std::max(left, right) / std::max(1.0, profile.crest_height);
}

/// The body without its rim.
cv::Mat1b core_of(const cv::Mat1b& body, int rim) {
  cv::Mat1b core;
  cv::erode(body, core, cv::getStructuringElement(cv::MORPH_RECT, {2 * rim + 1, 2 * rim + 1}),
            {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  return core;
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
    longest = std::max<double>(longest, std::hypot(s[2] - s[0], s[3] - s[1]));
  }
  return longest / std::max(1.0, reading.profile.crest_height);
}

double patchy_part(const Reading& reading, const WorkingPicture& work) {
  const double height = reading.profile.crest_height;
  const int step = std::max(1, static_cast<int>(kPatchStep * height));
  const cv::Mat1b core = core_of(reading.body.mask, kRim_px);
  cv::Mat1f weight;
  core.convertTo(weight, CV_32F, 1 / 255.0);
  std::array<cv::Mat1f, 3> lab;
  cv::split(work.lab, lab.data());
  for (cv::Mat1f& plane : lab) plane = smoothed(plane, core, kPatchBlur * height);
  int pairs = 0;
  int changed = 0;
  for (const cv::Point shift : {cv::Point(step, 0), cv::Point(0, step)}) {
    for (int row = 0; row + shift.y < core.rows; row += 2) {
      for (int col = 0; col + shift.x < core.cols; col += 2) {
        const int there_row = row + shift.y;
        const int there_col = col + shift.x;
        if (core(row, col) == 0 || core(there_row, there_col) == 0) continue;
        double squares = 0;
        for (const cv::Mat1f& plane : lab) {
          const double change = plane(there_row, there_col) - plane(row, col);
          squares += change * change;
        }
        ++pairs;
        changed += squares > kPatchChange * kPatchChange ? 1 : 0;
      }
    }
  }
  return pairs > 0 ? static_cast<double>(changed) / pairs : 0;
}

}  // namespace

Likeness likeness_of(const Reading& reading, const WorkingPicture& work) {
  return {.filled = filled_part(reading, work),
          .climb = climb_of(reading.profile),
          .straight = longest_edge_inside(reading, work),
          .patchy = patchy_part(reading, work)};
}

}  // namespace repose::vision
