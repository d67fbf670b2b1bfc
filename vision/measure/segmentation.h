#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/measure/working_picture.h"

namespace repose::vision {

/// One way of separating the heap from the rest. `inside` is a smooth field, > 0 where the heap is
/// believed to be; the edge is where it crosses 0 between two pixels, at subpixel precision.
struct Segmentation {
  std::string name;
  cv::Mat1f inside;
  /// Standard uncertainty of the edge's position, apart from the grains' scatter [working px].
  double deviation_px = 0;
};

/// Segmentations that need only the picture: Otsu on several channels, distance from a backdrop
/// model, adaptive threshold.
std::vector<Segmentation> unsupervised_segmentations(const WorkingPicture& work);

inline constexpr const char* kTwoTones = "two tones";  ///< name of the next one

/// For a picture that has only two colours: no segmentation could do better. The edge is where a
/// pixel is half one colour and half the other.
Segmentation two_tone_segmentation(const WorkingPicture& work, const Tones& tones);

/// By texture alone: finds grains in front of a backdrop of their own colour, with a blurred edge.
Segmentation rough_segmentation(const WorkingPicture& work);

/// Plain Otsu on the grey picture.
Segmentation grey_otsu(const WorkingPicture& work);

/// Otsu's threshold of `values` where `valid_mask` is set, in the units of `values`.
double otsu_threshold(const cv::Mat1f& values, const cv::Mat1b& valid_mask);

/// Gaussian average over the valid pixels alone: excluded ones have no influence. Values stay
/// unchanged if no valid pixel is within reach.
cv::Mat1f smoothed(const cv::Mat1f& values, const cv::Mat1b& valid_mask, double sigma_px);

/// Local standard deviation of lightness: grains are rough, backdrops smooth.
cv::Mat1f roughness(const cv::Mat1f& lightness, const cv::Mat1b& valid_mask, double sigma_px);

}  // namespace repose::vision
