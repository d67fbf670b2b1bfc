#include "tests/support/drawn_film.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "tests/support/drawn_board.h"
#include "vision/picture/opencv.h"

namespace repose::testing {

cv::Mat drawn_scene(const cv::Size& size, unsigned seed, bool is_other) {
  cv::RNG random(seed + (is_other ? 77 : 0));
  cv::Mat coarse(7, 9, CV_32FC3), scene;
  random.fill(coarse, cv::RNG::UNIFORM, is_other ? 20 : 165, is_other ? 90 : 205);
  cv::resize(coarse, scene, size, 0, 0, cv::INTER_CUBIC);
  const int floor = cvRound(kFloorPart * size.height);
  scene(cv::Rect(0, floor, size.width, size.height - floor)) *= .55;
  for (int k = 0; k < 12; ++k) {
    // One by one: the evaluation order of a call's arguments depends on the compiler.
    const int y = random.uniform(0, floor), x = random.uniform(0, size.width);
    const double grey = random.uniform(90., 150.);
    const int radius = random.uniform(2, 6);
    cv::circle(scene, {x, y}, radius, cv::Scalar::all(grey), cv::FILLED, cv::LINE_AA);
  }
  cv::GaussianBlur(scene, scene, {3, 3}, .7);
  return scene;
}

void draw_film_board(cv::Mat& scene, const cv::Point2d& middle, double square_px) {
  // At a distance equal to the focal length, so that a millimetre is a pixel.
  constexpr double kFar = 1e4;
  const BoardCamera camera{.width = scene.cols,
                           .height = scene.rows,
                           .focal_px = kFar,
                           .centre_x_px = middle.x,
                           .centre_y_px = middle.y};
  vision::Picture picture = vision::blank_picture(scene.cols, scene.rows);
  cv::Mat drawn = vision::mat_of(picture);
  scene.convertTo(drawn, CV_8UC3);
  draw_board(camera, placed_board({0, 0, kFar}, 0, 0, 0, square_px), {.noise = 0}, picture);
  drawn.convertTo(scene, CV_32FC3);
}

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
  const cv::Size half(cvRound(width), std::max(1, cvRound(.3 * width)));
  const int blur = cvRound(.4 * width);
  const cv::Point middle = at;
  const cv::Size reach = half + cv::Size(2 * blur, 2 * blur);
  const cv::Rect part =
      cv::Rect(middle - cv::Point(reach), middle + cv::Point(reach)) & cv::Rect({}, scene.size());
  if (part.empty()) return;
  cv::Mat shade(part.size(), CV_32F, cv::Scalar(0));
  cv::ellipse(shade, middle - part.tl(), half, 0, 0, 360, depth, cv::FILLED);
  cv::GaussianBlur(shade, shade, {2 * blur + 1, 2 * blur + 1}, 0);
  cv::Mat shaded = scene(part);
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) shaded.at<cv::Vec3f>(y, x) *= 1 - shade.at<float>(y, x);
  }
}

cv::Mat exposed(const cv::Mat& scene, int parts,
                const std::function<void(cv::Mat& now, int part)>& draw) {
  cv::Mat now, sum(scene.size(), CV_32FC3, cv::Scalar::all(0));
  for (int part = 0; part < parts; ++part) {
    scene.copyTo(now);
    draw(now, part);
    cv::scaleAdd(now, 1.0 / parts, sum, sum);
  }
  return sum;
}

vision::Picture noisy_picture(cv::Mat drawn, double noise, unsigned seed) {
  cv::RNG random(seed);
  cv::Mat grain(drawn.size(), CV_32FC3);
  random.fill(grain, cv::RNG::NORMAL, 0, noise);
  drawn += grain;
  vision::Picture result{.width = drawn.cols, .height = drawn.rows, .bgr = {}};
  result.bgr.resize(drawn.total() * 3);
  cv::Mat bytes(drawn.rows, drawn.cols, CV_8UC3, result.bgr.data());
  drawn.convertTo(bytes, CV_8UC3);
  return result;
}

}  // namespace repose::testing
