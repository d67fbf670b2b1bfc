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

/// The two colours of a picture in which every pixel is one or the other. std::nullopt for all
/// other pictures.
std::optional<Tones> tones_of(const cv::Mat3b& bgr);

bool is_grey(const Tones& tones);

/// The user's hints, in the working picture's coordinates.
struct UserHints {
  bool has_box = false;  ///< the frame is a box around the heap
  std::optional<PictureLine> ground;
  double ground_deviation_rad = 0;  ///< standard uncertainty of its tilt
  cv::Mat1b on_heap;                ///< 255 there; empty if nothing is marked
  cv::Mat1b beside_heap;            ///< likewise

  bool has_places() const { return !on_heap.empty() || !beside_heap.empty(); }
  bool empty() const { return !has_box && !ground && !has_places(); }
};

/// The picture at the size used for finding heaps: at most kWorkingSide pixels a side.
///
/// A flank's angle comes from hundreds of edge points that scatter because of grains, not pixels;
/// more pixels cost time and add no information.
struct WorkingPicture {
  cv::Mat3b bgr;
  cv::Mat3f lab;               ///< CIE L*a*b*, L 0 to 100
  cv::Mat1b valid_mask;        ///< 255 where the picture counts: not excluded, not letterbox
  cv::Rect frame;              ///< the picture without its letterbox
  std::optional<Tones> tones;  ///< of a picture with only two colours
  double shrink = 1;           ///< picture pixels per working pixel
  Point origin;                ///< its corner in the picture: that of the box around the heap
  UserHints told;

  /// Converts a point of the working picture to picture coordinates.
  Point in_picture(const Point& working) const {
    return {origin.x + working.x * shrink, origin.y + working.y * shrink};
  }
};

inline constexpr int kWorkingSide = 800;

/// The part of the picture inside the hints' box, or all of it. Hints and boxes must lie inside the
/// picture.
WorkingPicture working_picture(const Picture& picture, const std::vector<Box>& excluded,
                               const Hints& hints = {});

}  // namespace repose::vision
