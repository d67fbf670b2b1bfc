#pragma once

#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/film/scene_change.h"

namespace repose::vision {

/// The scene without moving objects.
struct Background {
  cv::Mat bgr;
  double noise = 0;  ///< standard deviation of a grey level from frame to frame
};

/// Difference of each pixel in the channel that differs most.
cv::Mat greatest_difference(const cv::Mat& a, const cv::Mat& b);

/// Median of each byte, over pictures of one size.
cv::Mat median_of(std::span<const cv::Mat> frames);

/// The median of frames from the whole video. Where something stayed long at the beginning or at
/// the end (a hand, the grain at rest), the one of the two that has no edge there.
Background background_of(const std::vector<cv::Mat>& samples);

/// Something in a frame that is not the background.
struct Blob {
  cv::Point2d centre = {};  ///< [px], pixel centres at (.5, .5)
  double crest_px = 0;      ///< row of its upper edge above the centre, not shifted by shadows
  double area_px = 0;       ///< sum of the pixels' coverage
  double contrast = 0;      ///< difference from the background, in grey levels
  cv::Vec3d colour = {};
  cv::Rect box;
  bool touches_edge = false;  ///< touches the frame's edge: part of it may be out of view
};

/// Fraction of a pixel that a thing covers, 0 to 1: where its colour lies between the background's
/// and the thing's own. Shadows on the background score low.
double cover_of(const cv::Vec3b& seen, const cv::Vec3b& background, const cv::Vec3d& thing);

/// Factor by which frames are reduced for the search: to about 960 pixels.
int reduction_for(const cv::Size& size);
cv::Mat reduced_frame(const cv::Mat& bgr, int reduction);

struct Look {
  std::vector<Blob> blobs = {};  ///< the largest ones, from left to right
  cv::Point2d shift;             ///< of the whole scene, relative to the background [px]
};

/// Finds blobs in successive frames: roughly in a reduced frame, their centres in the full one,
/// weighted by how much of each pixel is covered. A blurred blob's centre is that at the middle of
/// the exposure. Shadows with less than half of the thing's contrast are left out.
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
