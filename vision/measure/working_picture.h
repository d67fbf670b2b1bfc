#pragma once

#include <array>
#include <optional>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/measure/geometry.h"
#include "vision/measure/hints.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// Two colours, as in a mask or a rendered silhouette.
using Tones = std::array<cv::Vec3b, 2>;

/// The two colours of a picture in which every pixel is one or the other. Empty for all other
/// pictures.
std::optional<Tones> tones_of(const cv::Mat3b& bgr);

bool is_grey(const Tones& tones);

/// What a person has said of a working picture.
struct UserHints {
  bool has_box = false;  ///< the frame is a box around the heap
  std::optional<PictureLine> ground;
  double ground_deviation_rad = 0;  ///< standard uncertainty of its tilt
  cv::Mat1b on_heap;                ///< 255 there; empty when nothing is said
  cv::Mat1b beside_heap;            ///< likewise

  bool has_places() const { return !on_heap.empty() || !beside_heap.empty(); }
  bool empty() const { return !has_box && !ground && !has_places(); }
};

/// The picture at the size at which heaps are found: at most kWorkingSide pixels a side.
///
/// A flank's angle comes from hundreds of edge points that grains, not pixels, scatter; more pixels
/// cost time and tell nothing more.
struct WorkingPicture {
  cv::Mat3b bgr;
  cv::Mat3f lab;               ///< CIE L*a*b*, L 0 to 100
  cv::Mat1b valid_mask;        ///< 255 where the picture counts: not excluded, no letterbox
  cv::Rect frame;              ///< the picture without its letterbox
  std::optional<Tones> tones;  ///< of a picture that has only two colours
  double shrink = 1;           ///< pixels of the picture in a working pixel
  Point origin;                ///< its corner in the picture: that of the box around the heap
  UserHints told;

  /// A point of the working picture in the picture.
  Point in_picture(const Point& working) const {
    return {origin.x + working.x * shrink, origin.y + working.y * shrink};
  }
};

inline constexpr int kWorkingSide = 800;

/// The part of the picture inside the box of the hints, or all of it. Hints and boxes lie inside
/// the picture.
WorkingPicture working_picture(const Picture& picture, const std::vector<Box>& excluded,
                               const Hints& hints = {});

}  // namespace repose::vision
