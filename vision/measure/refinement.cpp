#include "vision/measure/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace repose::vision {
namespace {

constexpr int kFeatures = 6;  // L*, a*, b*, roughness, u, u^2
using Feature = cv::Vec<double, kFeatures>;
using Covariance = cv::Matx<double, kFeatures, kFeatures>;

constexpr float kBandNear = 2;         // px from the edge: nothing is learned from mixed pixels
constexpr double kBandFraction = 0.3;  // of the body's height: how far from the edge it learns
constexpr int kGrabCutSide = 240;      // px; the cost grows with the square
constexpr int kGrabCutRounds = 3;

struct FeatureImages {
  std::array<cv::Mat1f, 4> plane;  ///< L*, a*, b*, roughness
  double width;

  explicit FeatureImages(const WorkingPicture& work) : width(work.lab.cols) {
    std::array<cv::Mat1f, 3> lab;
    cv::split(work.lab, lab.data());
    for (std::size_t i = 0; i < 3; ++i) plane[i] = smoothed(lab[i], work.valid_mask, 0.8);
    plane[3] = smoothed(roughness(lab[0], work.valid_mask, 1.5), work.valid_mask, 0.8);
  }
  Feature at(int row, int col) const {
    const double u = 2 * col / width - 1;
    return {
        plane[0](row, col), plane[1](row, col), plane[2](row, col), plane[3](row, col), u, u * u};
  }
};

struct Class {
  std::vector<Feature> samples;

  Feature mean() const {
    Feature sum;
    for (const Feature& f : samples) sum += f;
    return sum * (1.0 / std::max<double>(1, static_cast<double>(samples.size())));
  }
  Covariance covariance() const {
    const Feature m = mean();
    Covariance sum = Covariance::zeros();
    for (const Feature& f : samples) sum += (f - m) * (f - m).t();
    return sum * (1.0 / std::max<double>(1, static_cast<double>(samples.size())));
  }
};

cv::Mat1b below_ground(const WorkingPicture& work, const PictureLine& ground) {
  cv::Mat1b below = cv::Mat1b::zeros(work.lab.size());
  for (int col = 0; col < below.cols; ++col) {
    const int first = std::clamp(static_cast<int>(std::lround(ground.y(col + 0.5))), 0, below.rows);
    for (int row = first; row < below.rows; ++row) below(row, col) = 255;
  }
  return below;
}

}  // namespace

Segmentation learned_segmentation(const WorkingPicture& work, const Body& body) {
  const FeatureImages images(work);
  const cv::Mat1b below = below_ground(work, body.ground);
  cv::Mat1f into;  // distance into the body; the ground is not an edge
  cv::distanceTransform(body.mask | below, into, cv::DIST_L2, 3);
  cv::Mat1f away;
  cv::distanceTransform(~body.mask, away, cv::DIST_L2, 3);
  const auto reach =
      static_cast<float>(std::max(8.0, kBandFraction * cv::boundingRect(body.mask).height));
  Class inside;
  Class outside;
  for (int row = 0; row < below.rows; row += 2) {
    for (int col = 0; col < below.cols; col += 2) {
      if (below(row, col) != 0 || work.valid_mask(row, col) == 0) continue;
      const bool in = body.mask(row, col) != 0;
      const float distance = in ? into(row, col) : away(row, col);
      if (distance <= kBandNear || distance > reach) continue;
      (in ? inside : outside).samples.push_back(images.at(row, col));
    }
  }
  Segmentation learned{"learned", cv::Mat1f(work.lab.size(), -1.F)};
  if (inside.samples.size() < 50 || outside.samples.size() < 50) return learned;
  Covariance within = inside.covariance() + outside.covariance();
  for (int i = 0; i < kFeatures; ++i) within(i, i) += i < 4 ? 1.0 : 1e-3;
  const Feature weights = within.solve(inside.mean() - outside.mean(), cv::DECOMP_CHOLESKY);
  // The threshold divides the step in units of standard deviations: a rough side gets more room.
  const auto spread = [&](const Class& c) {
    return std::sqrt(std::max(1e-12, weights.dot(c.covariance() * weights)));
  };
  const double in = weights.dot(inside.mean());
  const double out = weights.dot(outside.mean());
  const double threshold = out + (in - out) * spread(outside) / (spread(outside) + spread(inside));
  for (int row = 0; row < below.rows; ++row) {
    for (int col = 0; col < below.cols; ++col) {
      if (below(row, col) != 0) continue;
      learned.inside(row, col) = static_cast<float>(weights.dot(images.at(row, col)) - threshold);
    }
  }
  return learned;
}

namespace {

/// GrabCut at reduced size, for speed. `labels` have the working picture's size.
Segmentation grab_cut(const std::string& name, const WorkingPicture& work, const cv::Mat1b& labels,
                      std::uint64_t seed) {
  const double scale =
      std::min(1.0, static_cast<double>(kGrabCutSide) / std::max(work.bgr.cols, work.bgr.rows));
  cv::Mat small;
  cv::resize(work.bgr, small, {}, scale, scale, cv::INTER_AREA);
  cv::Mat1b believed;
  cv::resize(labels, believed, small.size(), 0, 0, cv::INTER_NEAREST);
  Segmentation cut{name, cv::Mat1f(work.lab.size(), -1.F)};
  const auto is_heap = [](const cv::Mat1b& by) {
    return cv::Mat1b((by == cv::GC_FGD) | (by == cv::GC_PR_FGD));
  };
  const int sure = cv::countNonZero(is_heap(believed));
  if (sure < 20 || sure > 0.9 * static_cast<double>(small.total())) return cut;
  cv::setRNGSeed(static_cast<int>(seed & 0x7fffffff));  // this thread's generator only
  cv::Mat background;
  cv::Mat foreground;
  cv::grabCut(small, believed, {}, background, foreground, kGrabCutRounds, cv::GC_INIT_WITH_MASK);
  cv::Mat1f field;
  is_heap(believed).convertTo(field, CV_32F, 2 / 255.0, -1);
  cv::resize(field, cut.inside, work.lab.size(), 0, 0, cv::INTER_LINEAR);
  return cut;
}

/// The triangle that a heap fills of the frame, above the ground if that is given.
cv::Mat1b triangle_in(const WorkingPicture& work) {
  const cv::Rect& frame = work.frame;
  const auto foot = [&](int col) {
    const double level = work.told.ground ? work.told.ground->y(col + 0.5) : frame.br().y;
    return cv::Point(col, std::clamp(static_cast<int>(level), frame.y + 1, frame.br().y));
  };
  const std::vector<cv::Point> corners = {
      foot(frame.x), foot(frame.br().x), {frame.x + frame.width / 2, frame.y}};
  cv::Mat1b triangle = cv::Mat1b::zeros(work.bgr.size());
  cv::fillConvexPoly(triangle, corners, 255);
  return triangle;
}

}  // namespace

Segmentation grabcut_segmentation(const WorkingPicture& work, const Body& body,
                                  std::uint64_t seed) {
  cv::Mat1b labels(work.bgr.size(), static_cast<std::uint8_t>(cv::GC_PR_BGD));
  labels.setTo(cv::GC_PR_FGD, body.mask);
  labels.setTo(cv::GC_BGD, below_ground(work, body.ground));
  return grab_cut("grabcut", work, labels, seed);
}

Segmentation seeded_segmentation(const WorkingPicture& work, std::uint64_t seed) {
  cv::Mat1b labels(work.bgr.size(), static_cast<std::uint8_t>(cv::GC_PR_BGD));
  labels.setTo(cv::GC_PR_FGD, triangle_in(work));
  labels.setTo(cv::GC_BGD, ~work.valid_mask);
  if (!work.told.on_heap.empty()) labels.setTo(cv::GC_FGD, work.told.on_heap);
  if (!work.told.beside_heap.empty()) labels.setTo(cv::GC_BGD, work.told.beside_heap);
  return grab_cut("pointed out", work, labels, seed);
}

}  // namespace repose::vision
