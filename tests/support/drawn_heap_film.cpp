#include "tests/support/drawn_heap_film.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/drawn_film.h"
#include "tests/support/heap_picture.h"

namespace repose::testing {
namespace {

cv::Mat floating(vision::Picture& picture) {
  cv::Mat drawn;
  cv::Mat(picture.height, picture.width, CV_8UC3, picture.bgr.data()).convertTo(drawn, CV_32FC3);
  return drawn;
}

/// The layers from which a film's frames are composed.
struct Layers {
  cv::Mat empty, full;
  cv::Mat heap;  ///< fraction of each pixel of `full` that is heap
  cv::Point2d foot;
};

Layers layers_of(HeapScene scene) {
  scene.camera.noise = 0;
  DrawnHeap full = draw_heap(scene);
  scene.form.shape = Shape::nothing;
  DrawnHeap empty = draw_heap(scene);
  Layers layers{
      .empty = floating(empty.picture), .full = floating(full.picture), .heap = {}, .foot = {}};
  layers.heap = cv::Mat::zeros(layers.full.size(), CV_32F);
  layers.foot = {(full.ground.from.x + full.ground.to.x) / 2,
                 (full.ground.from.y + full.ground.to.y) / 2};
  std::vector<cv::Point> outline;
  for (const vision::Point& at : full.outline) outline.emplace_back(cvRound(at.x), cvRound(at.y));
  cv::fillPoly(layers.heap, std::vector<std::vector<cv::Point>>{outline}, 1);
  cv::dilate(layers.heap, layers.heap, cv::Mat());
  return layers;
}

/// The heap shrunk towards the middle of its foot.
cv::Mat grown(const Layers& layers, double size) {
  constexpr double kNothing = .05;
  if (size >= 1) return layers.full.clone();
  if (size < kNothing) return layers.empty.clone();
  const cv::Matx23d shrink(size, 0, (1 - size) * layers.foot.x, 0, size,
                           (1 - size) * layers.foot.y);
  cv::Mat heap, part, frame = layers.empty.clone();
  cv::warpAffine(layers.full, heap, shrink, frame.size(), cv::INTER_AREA);
  cv::warpAffine(layers.heap, part, shrink, frame.size());
  heap.copyTo(frame, part > .5);
  return frame;
}

void draw_stream(cv::Mat& frame, const cv::Point2d& foot, int number) {
  constexpr int kApart_px = 23, kFall_px = 9;
  for (int row = (number * kFall_px) % kApart_px; row < foot.y - .3 * frame.rows;
       row += kApart_px) {
    draw_ball(frame, {foot.x + row % 5 - 2., 1. * row}, 4, {60, 90, 130});
  }
}

void draw_timer(cv::Mat& frame, double time_s) {
  const int tenths = static_cast<int>(10 * time_s);
  const std::string text = std::to_string(tenths / 10) + '.' + std::to_string(tenths % 10) + " s";
  cv::putText(frame, text, {8, 22}, cv::FONT_HERSHEY_SIMPLEX, .6, cv::Scalar::all(250), 2);
}

void draw_passing_hand(cv::Mat& frame, double part) {
  const double reach = .45 * part * frame.cols;
  cv::ellipse(frame, cv::Point2d(frame.cols, .45 * frame.rows),
              cv::Size(cvRound(reach), cvRound(.13 * frame.rows)), 0, 0, 360,
              cv::Scalar(120, 150, 200), cv::FILLED, cv::LINE_AA);
}

void light(cv::Mat& frame, double flicker, int number) {
  constexpr double kBandsPerFrame = 1.4, kPhase = 2.1;
  for (int row = 0; row < frame.rows; ++row) {
    const double turn = kBandsPerFrame * row / frame.rows;
    frame.row(row) *= 1 + flicker * std::sin(2 * std::numbers::pi * turn + kPhase * number);
  }
}

}  // namespace

int DrawnHeapFilm::frames() const {
  return std::max(1, static_cast<int>(std::lround(frames_per_s * (grows_s + rests_s + hand_s))));
}

std::vector<vision::Picture> DrawnHeapFilm::pictures() const {
  const Layers layers = layers_of(scene);
  std::vector<vision::Picture> frames_drawn;
  for (int number = 0; number < frames(); ++number) {
    const double now_s = time_s(number);
    cv::Mat frame =
        grown(layers, grows_s > 0 ? grows_from + (1 - grows_from) * now_s / grows_s : 1);
    if (now_s < grows_s) draw_stream(frame, layers.foot, number);
    if (has_timer) draw_timer(frame, now_s);
    const double hand = now_s - grows_s - rests_s;
    if (hand_s > 0 && hand >= 0) draw_passing_hand(frame, (hand + 1 / frames_per_s) / hand_s);
    if (flicker > 0) light(frame, flicker, number);
    const auto seed = static_cast<unsigned>(scene.seed * 7919 + static_cast<unsigned>(number));
    frames_drawn.push_back(noisy_picture(frame, noise, seed));
  }
  return frames_drawn;
}

HeapScene small_heap(std::uint64_t seed, int width) {
  HeapScene scene;
  scene.seed = seed;
  scene.width = width;
  scene.height = width / 3 * 2;
  return scene;
}

}  // namespace repose::testing
