#pragma once

#include <deque>
#include <optional>
#include <utility>

#include <opencv2/core.hpp>

namespace repose::vision {

/// Finds the last stretch of a film in which nothing changes.
///
/// Each look is compared with the one before, which shows what moves, and with the one with which
/// its stretch begins, up to a second earlier, which shows what creeps.
class RestFinder {
 public:
  /// Shorter is no rest; longer is not waited for.
  static constexpr double kLeast_s = .5, kWhole_s = 1;

  struct Stretch {
    double from_s = 0;
    double to_s = 0;
  };

  /// @param counts  0 where changes are none of the heap's, of the frames' size or smaller; empty:
  ///   they count everywhere
  explicit RestFinder(cv::Mat counts) : counts_(std::move(counts)) {}

  /// Whether a frame of this time is to be looked at; of others there is enough in between.
  bool wants(double time_s) const;
  void look(const cv::Mat& frame, double time_s);

  /// The last one; none where all looks changed.
  const std::optional<Stretch>& rest() const { return rest_; }
  /// Where something moved after it, or at the end of a film without rest, in parts of the
  /// picture's width and height; empty: nowhere.
  cv::Rect2d moved_part() const;
  /// Whether all that moved after it came in from the left, the right or below.
  bool only_came_in() const;

 private:
  struct Look {
    double time_s = 0;
    cv::Mat picture;
  };

  cv::Mat changes(const cv::Mat& look, const cv::Mat& earlier) const;
  void find_rest();

  cv::Mat counts_;
  std::deque<Look> still_;  ///< since the last movement, of the last second
  cv::Mat at_rest_;         ///< the last look of the rest
  cv::Mat moved_;           ///< after it
  std::optional<Stretch> rest_;
};

}  // namespace repose::vision
