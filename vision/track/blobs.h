#pragma once

#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/film/scene_change.h"

namespace repose::vision {

/// The scene without what moves in it.
struct Background {
  cv::Mat bgr;
  double noise = 0;  ///< standard deviation of a grey level from frame to frame
};

/// Of each pixel the difference in the channel that differs most.
cv::Mat greatest_difference(const cv::Mat& a, const cv::Mat& b);

/// Of each byte of pictures of one size, the median.
cv::Mat median_of(std::span<const cv::Mat> frames);

/// The median of frames from all over a film. Where something lay for long at the beginning or at
/// the end (a hand, the grain at rest), whichever of the two has no edge around it.
Background background_of(const std::vector<cv::Mat>& samples);

/// Something in a frame that is not the background.
struct Blob {
  cv::Point2d centre = {};  ///< [px], pixel centres at (.5, .5)
  double crest_px = 0;      ///< row of its upper edge above the centre, which no shadow moves
  double area_px = 0;       ///< in full pixels' worth of it
  double contrast = 0;      ///< how much it differs from the background, in grey levels
  cv::Vec3d colour = {};
  cv::Rect box;
  bool touches_edge = false;  ///< of the frame: not all of it is seen
};

/// How much of a pixel a thing covers, 0 to 1: where its colour lies between the background's and
/// the thing's own. Shadows of the background do not get far that way.
double cover_of(const cv::Vec3b& seen, const cv::Vec3b& background, const cv::Vec3d& thing);

/// How many times smaller frames are made in which things are looked for: to some 960 pixels.
int reduction_for(const cv::Size& size);
cv::Mat reduced_frame(const cv::Mat& bgr, int reduction);

struct Look {
  std::vector<Blob> blobs = {};  ///< the largest ones, from the left to the right
  cv::Point2d shift;  ///< of the scene as a whole from where it lay in the background [px]
};

/// Finds blobs in one frame after the other: roughly in a reduced frame, their centres in the full
/// one, weighed by how much each pixel is covered. That holds for blurred ones too, whose centre is
/// that of the middle of the exposure, and leaves out shadows fainter than a fourth of the thing.
class BlobFinder {
 public:
  explicit BlobFinder(Background background);

  Look look(const cv::Mat& frame) const;

  const cv::Mat& scene() const { return background_.bgr; }

 private:
  std::vector<cv::Rect> rough_places(const cv::Mat& small, cv::Mat& labels,
                                     std::vector<int>& numbers) const;
  Blob refine(const cv::Mat& frame, const cv::Rect& place, const cv::Mat& mask) const;
  double crest(const cv::Mat& seen, const cv::Mat& mask, const Blob& blob) const;

  Background background_;
  int reduction_ = 1;
  cv::Mat reduced_;
  SceneShift shift_;
};

}  // namespace repose::vision
