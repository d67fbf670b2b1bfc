#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/measure/working_picture.h"

namespace repose::vision {

/// One way to tell heap from not-heap. `inside` is a smooth field, > 0 where the heap is believed
/// to be; where it crosses 0 between two pixels is the edge, finer than a pixel.
struct Segmentation {
  std::string name;
  cv::Mat1f inside;
  /// Standard uncertainty of where the edge is, beside the grains' scatter [working px].
  double deviation_px = 0;
};

/// Segmentations that need nothing but the picture: Otsu on several channels, distance from a
/// backdrop model, adaptive threshold.
std::vector<Segmentation> unsupervised_segmentations(const WorkingPicture& work);

inline constexpr const char* kTwoTones = "two tones";  ///< name of the next one

/// Of a picture that has only two colours: no segmentation could tell more. The edge is where half
/// of a pixel has the one, and half the other.
Segmentation two_tone_segmentation(const WorkingPicture& work, const Tones& tones);

/// By texture alone: finds grains before a backdrop of their own colour, with a blurred edge.
Segmentation rough_segmentation(const WorkingPicture& work);

/// Otsu on the grey picture and nothing else.
Segmentation grey_otsu(const WorkingPicture& work);

/// Otsu's threshold of `values` where `valid_mask` is set, in the units of `values`.
double otsu_threshold(const cv::Mat1f& values, const cv::Mat1b& valid_mask);

/// Gaussian average over the valid pixels alone: what is excluded does not shine in. Where there is
/// none within reach the values stay as they are.
cv::Mat1f smoothed(const cv::Mat1f& values, const cv::Mat1b& valid_mask, double sigma_px);

/// Local standard deviation of lightness: grains are rough, backdrops smooth.
cv::Mat1f roughness(const cv::Mat1f& lightness, const cv::Mat1b& valid_mask, double sigma_px);

}  // namespace repose::vision
