#include "tests/support/drawn_drop.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/drawn_film.h"

namespace repose::testing {
double DrawnDrop::height_mm(double time_s) const {
  double t = time_s - release_s;
  if (t <= 0) return drop_mm;
  const double fall_s = std::sqrt(2 * drop_mm / kGravity_mm_s2);
  if (t < fall_s) return drop_mm - .5 * kGravity_mm_s2 * t * t;
  t -= fall_s;
  double speed = kGravity_mm_s2 * fall_s * restitution;
  while (t > 2 * speed / kGravity_mm_s2) {
    t -= 2 * speed / kGravity_mm_s2;
    speed *= restitution;
    if (speed < 1) return 0;
  }
  return t * (speed - .5 * kGravity_mm_s2 * t);
}

cv::Mat DrawnDrop::scene() const {
  cv::Mat still = drawn_scene({width, height}, seed);
  if (board_square_px > 0) draw_film_board(still, {.73 * width, .42 * height}, board_square_px);
  return still;
}

vision::Picture DrawnDrop::picture(int frame, const cv::Mat& scene) const {
  const bool is_other = cut >= 0 && frame >= cut;
  const cv::Mat behind = is_other ? drawn_scene({width, height}, seed, true) : scene;
  const int parts = exposure > 0 ? 8 : 1;
  const double floor = kFloorPart * height + radius_px * .3;
  const double turn_c = std::cos(roll_rad), turn_s = std::sin(roll_rad);
  cv::Mat seen = exposed(behind, parts, [&](cv::Mat& now, int part) {
    const double begin_s = (frame + exposure * ((part + .5) / parts - .5)) / frames_per_s;
    for (int grain = 0; grain < grains; ++grain) {
      cv::Point2d at;
      double time_s = begin_s;
      // Rows that are read out later show a later time.
      for (int round = 0; round < 4; ++round) {
        const double flown_s = std::max(0.0, time_s - release_s - .04 * grain);
        const double up = height_mm(time_s - .04 * grain) / mm_per_px;
        const cv::Point2d plain(.35 * width + 90 * grain + sideways_px_s * flown_s - .5 * width,
                                floor - up - radius_px - .5 * height);
        at = {plain.x * turn_c - plain.y * turn_s + .5 * width,
              plain.x * turn_s + plain.y * turn_c + .5 * height};
        time_s = begin_s + readout_s * (at.y / height - .5);
      }
      if (has_shadow) draw_shadow(now, {at.x + 14, floor + 2}, 1.3 * radius_px, .35);
      draw_ball(now, at, radius_px, {50, 75, 120});
    }
    if (has_hand && begin_s < release_s + .5) {
      const double gone = std::max(0.0, begin_s - release_s) * 400;
      const cv::Point2d hand(.35 * width + gone,
                             floor - drop_mm / mm_per_px - 2.6 * radius_px - .4 * gone);
      cv::ellipse(now, hand, {cvRound(3 * radius_px), cvRound(1.6 * radius_px)}, -20, 0, 360,
                  cv::Scalar(120, 140, 190), cv::FILLED, cv::LINE_AA);
    }
  });
  if (shake_px > 0) {
    const cv::Matx23d move(1, 0, shake_px * std::sin(.9 * frame), 0, 1,
                           shake_px * std::cos(1.3 * frame));
    cv::warpAffine(seen, seen, move, seen.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }
  return noisy_picture(seen, noise, seed * 1000003U + static_cast<unsigned>(frame));
}

}  // namespace repose::testing
