#include "tests/support/drawn_roll.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/drawn_film.h"

namespace repose::testing {
namespace {

/// Ball and planes, in pixels from the foot, x along the flat and y up.
struct Course {
  explicit Course(const DrawnRoll& roll)
      : slope(roll.incline_deg * std::numbers::pi / 180),
        radius(roll.radius_px),
        corner(radius * std::tan(.5 * slope)),
        down(roll.released_mm / roll.mm_per_px - corner),
        out(roll.stopped_mm / roll.mm_per_px - corner),
        roll_s(roll.roll_s),
        hop(roll.hop_px) {}

  /// Accelerates down and decelerates on the flat; the speed is continuous at the corner.
  cv::Point2d centre(double time_s) const {
    const double down_s = roll_s * down / (down + out), out_s = roll_s - down_s;
    const double t = std::clamp(time_s, 0.0, roll_s);
    if (t < down_s) {
      const double left = down * (1 - t * t / (down_s * down_s));
      return {corner - left * std::cos(slope), radius + left * std::sin(slope)};
    }
    const double left = 1 - (t - down_s) / out_s;
    constexpr double kHop_s = .15;
    const double hopped = std::min(1.0, (t - down_s) / kHop_s);
    return {corner + out * (1 - left * left), radius + 4 * hop * hopped * (1 - hopped)};
  }

  double slope, radius;
  double corner;  ///< distance of the centre path's corner from the foot
  double down, out;
  double roll_s;
  double hop;
};

/// Maps coordinates from the foot to the picture.
cv::Point2d placed(const DrawnRoll& roll, const cv::Point2d& at) {
  constexpr double kFootPart = .36;
  const double across = kFootPart * roll.width + at.x - .5 * roll.width;
  const cv::Point2d plain(roll.goes_left ? -across : across,
                          kFloorPart * roll.height - at.y - .5 * roll.height);
  const double c = std::cos(roll.roll_rad), s = std::sin(roll.roll_rad);
  return {plain.x * c - plain.y * s + .5 * roll.width,
          plain.x * s + plain.y * c + .5 * roll.height};
}

void draw_incline(cv::Mat& scene, const DrawnRoll& roll, const Course& course) {
  const double far = 2.0 * roll.width;
  std::vector<cv::Point> corners;
  for (const cv::Point2d& at :
       {cv::Point2d(0, 0), cv::Point2d(-far, far * std::tan(course.slope)), cv::Point2d(-far, 0)}) {
    corners.emplace_back(placed(roll, at));
  }
  cv::fillPoly(scene, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(130, 140, 145),
               cv::LINE_AA);
}

void draw_grain(cv::Mat& scene, DrawnRoll roll, int grain, double time_s) {
  constexpr double kLower_mm = 45, kEarlier_mm = 60;
  roll.released_mm -= kLower_mm * grain;
  roll.stopped_mm -= kEarlier_mm * grain;
  cv::Point2d at = Course(roll).centre(time_s - roll.release_s);
  if (!roll.has_incline) at.y = roll.radius_px;
  const cv::Point2d centre = placed(roll, at);
  if (roll.has_shadow) {
    draw_shadow(scene, centre + cv::Point2d(8, roll.radius_px + 2), 1.2 * roll.radius_px, .3);
  }
  draw_ball(scene, centre, roll.radius_px, {50, 75, 120});
}

}  // namespace

cv::Mat DrawnRoll::scene() const {
  cv::Mat still = drawn_scene({width, height}, seed);
  if (has_incline) draw_incline(still, *this, Course(*this));
  if (board_square_px > 0) draw_film_board(still, {.75 * width, .36 * height}, board_square_px);
  return still;
}

vision::Picture DrawnRoll::picture(int frame, const cv::Mat& scene) const {
  const Course course(*this);
  const int parts = exposure > 0 ? 8 : 1;
  const cv::Mat seen = exposed(scene, parts, [&](cv::Mat& now, int part) {
    const double time_s = (frame + exposure * ((part + .5) / parts - .5)) / frames_per_s;
    for (int grain = 0; grain < grains; ++grain) draw_grain(now, *this, grain, time_s);
    if (has_hand && time_s < release_s + .4) {
      const double gone = std::max(0.0, time_s - release_s) * 500;
      const cv::Point2d hand =
          placed(*this, course.centre(0)) - cv::Point2d(0, 2.4 * radius_px + gone);
      cv::ellipse(now, hand, {cvRound(3 * radius_px), cvRound(1.6 * radius_px)}, -20, 0, 360,
                  cv::Scalar(120, 140, 190), cv::FILLED, cv::LINE_AA);
    }
  });
  return noisy_picture(seen, noise, seed * 1000003U + static_cast<unsigned>(frame));
}

}  // namespace repose::testing
