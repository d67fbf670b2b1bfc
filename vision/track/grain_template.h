#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace repose::vision {

/// Where something is found that was seen before.
struct TemplateMatch {
  cv::Point2d moved;      ///< [px]
  double turned_rad = 0;  ///< clockwise
  double likeness = 0;    ///< 1: it looks the same; 0: anything else would do as well
};

/// A piece of a picture that is found again in others to a fraction of a pixel, by least squares of
/// its colours, each less its mean. Source: S. Baker, I. Matthews, Lucas-Kanade 20 years on, Int.
/// J. Comput. Vision 56 (2004) 221-255, section 3.2 (the inverse compositional algorithm), for a
/// shift and a turn about the piece's centre. Holds for shifts of a pixel or so from where the
/// search begins, which goes through whole pixels first. Checked by track_tilt_test.cpp of
/// tests/vision.
class GrainTemplate {
 public:
  /// @param mask  of the picture's size: what belongs to it
  GrainTemplate(const cv::Mat& bgr, const cv::Mat& mask);

  /// Turned as expected.
  /// @param expected  where to begin
  /// @param reach_px  how far from there it may be along the rows
  TemplateMatch find(const cv::Mat& bgr, const TemplateMatch& expected, int reach_px) const;
  /// From a place that was found: with its turn.
  TemplateMatch find_turned(const cv::Mat& bgr, const TemplateMatch& found) const;

 private:
  struct Pixel {
    cv::Point2d place;  ///< from the centre
    cv::Vec3f colour;   ///< less the mean
    cv::Vec3f across, down;
  };

  bool sample(const cv::Mat& bgr, const TemplateMatch& match, std::vector<cv::Vec3f>& seen) const;
  double squares(const std::vector<cv::Vec3f>& seen) const;
  TemplateMatch refined(const cv::Mat& bgr, TemplateMatch match, bool turns) const;

  std::vector<Pixel> pixels_;
  cv::Point2d centre_;
  double contrast_ = 0;         ///< sum of the squared colours
  double mean_square_px2_ = 0;  ///< of the distances from the centre
};

}  // namespace repose::vision
