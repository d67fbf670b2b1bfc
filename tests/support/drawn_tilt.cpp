#include "tests/support/drawn_tilt.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/units.h"
#include "tests/support/drawn_film.h"

namespace repose::testing {
namespace {

constexpr double kApart = 1.8;  ///< distance of bonded balls, in radii

/// Distance slid down the plate after the onset: the weight along the plate less the kinetic
/// friction, integrated twice over time, while the plate keeps turning steadily.
double slid_mm(const DrawnTilt& tilt, double onset_deg, double since_s) {
  if (since_s <= 0) return 0;
  const double begin = onset_deg * kDegree, rate = tilt.rate_deg_s * kDegree;
  const double now = begin + rate * since_s, friction = tilt.slides_with * std::tan(begin);
  const double weight = since_s * std::cos(begin) - (std::sin(now) - std::sin(begin)) / rate;
  const double held = (std::cos(begin) - std::cos(now)) / rate - since_s * std::sin(begin);
  return kGravity_mm_s2 / rate * (weight - friction * held);
}

/// Maps the plate's coordinates to the picture: x along it from the hinge, y up from its upper
/// edge.
struct Placing {
  Placing(const DrawnTilt& tilt, double time_s)
      : tilt_(tilt),
        plate_(turn_by(tilt.angle_deg(time_s) * kDegree)),
        lean_(turn_by(tilt.roll_rad)),
        shift(tilt.shakes_px * std::sin(std::numbers::pi * time_s)) {}

  cv::Point2d in_picture(const cv::Point2d& at) const {
    const double c = plate_.x, s = plate_.y;
    // Half the plate's thickness lies below the hinge.
    const double y = at.y + .5 * tilt_.thickness_px;
    const cv::Point2d plain(tilt_.hinge_part * tilt_.width + at.x * c - y * s,
                            row_of_hinge() - at.x * s - y * c);
    return leaned(plain) + cv::Point2d(shift, 0);
  }
  cv::Point2d on_plate(const cv::Point2d& seen) const {
    const cv::Point2d plain = straightened(seen - cv::Point2d(shift, 0));
    const double x = plain.x - tilt_.hinge_part * tilt_.width, y = row_of_hinge() - plain.y;
    const double c = plate_.x, s = plate_.y;
    return {x * c + y * s, -x * s + y * c - .5 * tilt_.thickness_px};
  }

 private:
  double row_of_hinge() const { return tilt_.edge_row * tilt_.height + .5 * tilt_.thickness_px; }
  cv::Point2d leaned(const cv::Point2d& plain) const {
    const cv::Point2d middle(.5 * tilt_.width, .5 * tilt_.height);
    cv::Point2d off = plain - middle;
    if (tilt_.goes_left) off.x = -off.x;
    const double c = lean_.x, s = lean_.y;
    return middle + cv::Point2d(off.x * c - off.y * s, off.x * s + off.y * c);
  }
  cv::Point2d straightened(const cv::Point2d& seen) const {
    const cv::Point2d middle(.5 * tilt_.width, .5 * tilt_.height);
    const double c = lean_.x, s = lean_.y;
    cv::Point2d off = seen - middle;
    off = {off.x * c + off.y * s, -off.x * s + off.y * c};
    if (tilt_.goes_left) off.x = -off.x;
    return middle + off;
  }

  /// Cosine and sine.
  static cv::Point2d turn_by(double rad) { return {std::cos(rad), std::sin(rad)}; }

  const DrawnTilt& tilt_;
  cv::Point2d plate_;
  cv::Point2d lean_;

 public:
  double shift;
};

/// Blends each pixel by the fraction of it that the plate covers.
void draw_plate(cv::Mat& scene, const DrawnTilt& tilt, const Placing& placing) {
  const double from = (tilt.plate_from - tilt.hinge_part) * tilt.width;
  const double to = (tilt.plate_to - tilt.hinge_part) * tilt.width;
  for (int row = 0; row < scene.rows; ++row) {
    for (int k = 0; k < scene.cols; ++k) {
      const cv::Point2d at = placing.on_plate({k + .5, row + .5});
      const double inside = std::min({-at.y, at.y + tilt.thickness_px, at.x - from, to - at.x});
      const auto cover = static_cast<float>(std::clamp(inside + .5, 0.0, 1.0));
      if (cover <= 0) continue;
      const double mark =
          tilt.has_texture ? .12 * std::sin(.35 * at.x) * std::sin(1.1 * at.y + .02 * at.x * at.x)
                           : 0;
      const cv::Vec3f colour(cv::Vec3d(95, 90, 85) * (1 + mark));
      auto& pixel = scene.at<cv::Vec3f>(row, k);
      pixel += cover * (colour - pixel);
    }
  }
}

void draw_grain(cv::Mat& scene, const DrawnTilt& tilt, const Placing& placing, int grain,
                double time_s) {
  constexpr double kEarlier_deg = 2, kLower_px = 90;
  const double onset_deg = tilt.onset_deg - kEarlier_deg * grain;
  DrawnTilt own = tilt;
  own.onset_deg = onset_deg;
  const double onset_s = own.onset_s();
  const double slid_px = slid_mm(tilt, onset_deg, time_s - onset_s) / tilt.mm_per_px;
  const double creep_px =
      tilt.creeps_px * std::clamp((time_s - .5 * onset_s) / (.4 * onset_s), 0.0, 1.0);
  // Down the plate is towards the hinge.
  const double middle =
      (tilt.grain_part - tilt.hinge_part) * tilt.width - kLower_px * grain - slid_px - creep_px;
  const double turned = -tilt.rolls * slid_px / tilt.radius_px;
  const double r = tilt.radius_px;
  if (tilt.has_shadow) {
    draw_shadow(scene, placing.in_picture({middle + 6, .5 * r}), 1.2 * r * tilt.bonded, .15);
  }
  for (int k = 0; k < tilt.bonded; ++k) {
    const double off = (k - .5 * (tilt.bonded - 1)) * kApart * r;
    const cv::Point2d centre(middle + off * std::cos(turned), r - off * std::sin(turned));
    draw_ball(scene, placing.in_picture(centre), r, {50, 75, 120});
    if (!tilt.has_spot) continue;
    const cv::Point2d spot = centre + .55 * r * cv::Point2d(std::cos(turned), -std::sin(turned));
    draw_ball(scene, placing.in_picture(spot), .3 * r, {190, 190, 200});
  }
}

}  // namespace

double DrawnTilt::angle_deg(double time_s) const {
  const double t = std::max(0.0, time_s - rest_s);
  const double pi = std::numbers::pi;
  return rate_deg_s * (t + uneven / pi * (1 - std::cos(pi * t)));
}

double DrawnTilt::onset_s() const {
  double from = rest_s, to = rest_s + 2 * onset_deg / rate_deg_s;
  constexpr int kHalvings = 60;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = .5 * (from + to);
    (angle_deg(middle) < onset_deg ? from : to) = middle;
  }
  return from;
}

int DrawnTilt::frames() const { return static_cast<int>(frames_per_s * (onset_s() + after_s)); }

cv::Mat DrawnTilt::scene() const { return drawn_scene({width, height}, seed); }

vision::Picture DrawnTilt::picture(int frame, const cv::Mat& scene) const {
  const double middle_s = frame / frames_per_s;
  // Blurred only when the motion during the exposure is a considerable part of a pixel.
  constexpr double kBefore_s = .05;
  const bool is_blurred = exposure > 0 && middle_s > onset_s() - kBefore_s;
  const cv::Matx23d shaken(1, 0, Placing(*this, middle_s).shift, 0, 1, 0);
  cv::Mat moved = scene;
  if (shakes_px != 0) {
    cv::warpAffine(scene, moved, shaken, scene.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }
  const int parts = is_blurred ? 8 : 1;
  const cv::Mat seen = exposed(moved, parts, [&](cv::Mat& now, int part) {
    const double time_s = (frame + exposure * ((part + .5) / parts - .5)) / frames_per_s;
    const Placing placing(*this, time_s);
    for (int grain = 0; grain < grains; ++grain) draw_grain(now, *this, placing, grain, time_s);
    draw_plate(now, *this, placing);
  });
  return noisy_picture(seen, noise, seed * 1000003U + static_cast<unsigned>(frame));
}

}  // namespace repose::testing
