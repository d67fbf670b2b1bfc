#include "vision/film/rest_finder.h"

#include <opencv2/imgproc.hpp>

#include "vision/film/scene_change.h"

namespace repose::vision {

bool RestFinder::wants(double time_s) const {
  constexpr double kBetween_s = .079;
  return still_.empty() || time_s >= still_.back().time_s + kBetween_s;
}

cv::Mat RestFinder::changes(const cv::Mat& look, const cv::Mat& earlier) const {
  cv::Mat places = changed_places(look, earlier);
  if (counts_.empty()) return places;
  cv::Mat counts;
  cv::resize(counts_, counts, places.size(), 0, 0, cv::INTER_NEAREST);
  return places & counts;
}

void RestFinder::look(const cv::Mat& frame, double time_s) {
  const Look now{.time_s = time_s, .picture = reduced_look(frame)};
  cv::Mat moved;
  if (!still_.empty()) moved = changes(now.picture, still_.back().picture);
  const bool has_moved = !moved.empty() && cv::countNonZero(moved) > 0;
  if (has_moved) still_.clear();
  still_.push_back(now);
  // What one look later would begin the stretch is kept.
  constexpr double kRounding_s = 1e-6;
  while (time_s - still_.front().time_s > kWhole_s + kRounding_s) still_.pop_front();
  const double before_s = rest_ ? rest_->to_s : -1;
  find_rest();
  if (rest_ && rest_->to_s > before_s) return;
  if (!rest_) {
    if (has_moved) moved_ = moved;
    return;
  }
  const cv::Mat since = changes(now.picture, at_rest_);
  moved_ = moved_.empty() ? since : cv::Mat(moved_ | since);
}

void RestFinder::find_rest() {
  const Look& now = still_.back();
  for (const Look& first : still_) {
    if (now.time_s - first.time_s < kLeast_s) return;
    if (cv::countNonZero(changes(now.picture, first.picture)) > 0) continue;
    rest_ = {.from_s = first.time_s, .to_s = now.time_s};
    at_rest_ = now.picture;
    moved_.release();
    return;
  }
}

cv::Rect2d RestFinder::moved_part() const {
  if (moved_.empty() || cv::countNonZero(moved_) == 0) return {};
  const cv::Rect box = cv::boundingRect(moved_);
  return {1. * box.x / moved_.cols, 1. * box.y / moved_.rows, 1. * box.width / moved_.cols,
          1. * box.height / moved_.rows};
}

bool RestFinder::only_came_in() const {
  if (moved_.empty()) return true;
  cv::Mat joined, labels, stats, centres;
  cv::dilate(moved_, joined, cv::Mat());
  const int count = cv::connectedComponentsWithStats(joined, labels, stats, centres);
  for (int label = 1; label < count; ++label) {
    const int left = stats.at<int>(label, cv::CC_STAT_LEFT);
    const int top = stats.at<int>(label, cv::CC_STAT_TOP);
    const bool is_at_side =
        left == 0 || left + stats.at<int>(label, cv::CC_STAT_WIDTH) == joined.cols;
    const bool is_at_foot = top + stats.at<int>(label, cv::CC_STAT_HEIGHT) == joined.rows;
    if (!is_at_side && !is_at_foot) return false;
  }
  return true;
}

}  // namespace repose::vision
