#include "tests/support/drawn_drop.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace repose::testing {
namespace {

constexpr double kGravity_mm_s2 = 9806.65;
constexpr double kFloorPart = .88;  ///< of the picture's height, where the floor meets the wall

/// A wall with a soft pattern and a floor of another colour.
cv::Mat scene_of(const DrawnDrop& drop, bool is_other) {
  cv::RNG random(drop.seed + (is_other ? 77 : 0));
  cv::Mat coarse(7, 9, CV_32FC3), scene;
  random.fill(coarse, cv::RNG::UNIFORM, is_other ? 20 : 165, is_other ? 90 : 205);
  cv::resize(coarse, scene, {drop.width, drop.height}, 0, 0, cv::INTER_CUBIC);
  const int floor = cvRound(kFloorPart * drop.height);
  scene(cv::Rect(0, floor, drop.width, drop.height - floor)) *= .55;
  for (int k = 0; k < 12; ++k) {
    const cv::Point at(random.uniform(0, drop.width), random.uniform(0, floor));
    cv::circle(scene, at, random.uniform(2, 6), cv::Scalar::all(random.uniform(90., 150.)),
               cv::FILLED, cv::LINE_AA);
  }
  cv::GaussianBlur(scene, scene, {3, 3}, .7);
  return scene;
}

/// Mixes a disc of one colour, lit from the upper left, into the picture.
void draw_ball(cv::Mat& scene, const cv::Point2d& centre, double radius, const cv::Vec3f& colour) {
  const int reach = static_cast<int>(radius) + 2;
  const cv::Point middle(cvFloor(centre.x), cvFloor(centre.y));
  for (int y = std::max(0, middle.y - reach); y <= std::min(scene.rows - 1, middle.y + reach);
       ++y) {
    for (int x = std::max(0, middle.x - reach); x <= std::min(scene.cols - 1, middle.x + reach);
         ++x) {
      const double dx = x + .5 - centre.x, dy = y + .5 - centre.y;
      const double cover = std::clamp(radius + .5 - std::hypot(dx, dy), 0.0, 1.0);
      if (cover <= 0) continue;
      const auto light = static_cast<float>(.8 - .25 * (dx + dy) / radius);
      auto& pixel = scene.at<cv::Vec3f>(y, x);
      pixel += static_cast<float>(cover) * (light * colour - pixel);
    }
  }
}

void draw_shadow(cv::Mat& scene, const cv::Point2d& at, double width, double depth) {
  cv::Mat shade(scene.size(), CV_32F, cv::Scalar(0));
  cv::ellipse(shade, at, {cvRound(width), std::max(1, cvRound(.3 * width))}, 0, 0, 360, depth,
              cv::FILLED);
  const int size = 2 * cvRound(.4 * width) + 1;
  cv::GaussianBlur(shade, shade, {size, size}, 0);
  for (int y = 0; y < scene.rows; ++y) {
    for (int x = 0; x < scene.cols; ++x) scene.at<cv::Vec3f>(y, x) *= 1 - shade.at<float>(y, x);
  }
}

}  // namespace

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

vision::Picture DrawnDrop::picture(int frame) const {
  const cv::Mat scene = scene_of(*this, cut >= 0 && frame >= cut);
  cv::Mat sum(scene.size(), CV_32FC3, cv::Scalar::all(0));
  const int parts = exposure > 0 ? 8 : 1;
  const double floor = kFloorPart * height + radius_px * .3;
  const double turn_c = std::cos(lean_rad), turn_s = std::sin(lean_rad);
  for (int part = 0; part < parts; ++part) {
    const double begin_s = (frame + exposure * ((part + .5) / parts - .5)) / frames_per_s;
    cv::Mat now = scene.clone();
    for (int grain = 0; grain < grains; ++grain) {
      cv::Point2d at;
      double time_s = begin_s;
      // Rows that are read later show a later time.
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
    sum += now / parts;
  }
  cv::RNG random(seed * 1000003U + static_cast<unsigned>(frame));
  if (shake_px > 0) {
    const cv::Matx23d move(1, 0, shake_px * std::sin(.9 * frame), 0, 1,
                           shake_px * std::cos(1.3 * frame));
    cv::warpAffine(sum, sum, move, sum.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }
  cv::Mat grain(sum.size(), CV_32FC3);
  random.fill(grain, cv::RNG::NORMAL, 0, noise);
  sum += grain;
  vision::Picture result{.width = width, .height = height, .bgr = {}};
  result.bgr.resize(std::size_t{3} * static_cast<std::size_t>(width * height));
  cv::Mat bytes(height, width, CV_8UC3, result.bgr.data());
  sum.convertTo(bytes, CV_8UC3);
  return result;
}

}  // namespace repose::testing
