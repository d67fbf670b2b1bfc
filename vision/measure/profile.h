#pragma once

#include <vector>

#include "vision/measure/body.h"

namespace repose::vision {

/// The heap's upper edge, one point per working-picture column, in ground coordinates [working px].
struct Profile {
  std::vector<double> along;   ///< ascending
  std::vector<double> height;  ///< above the ground line
  double crest_height = 0;     ///< of the lightly smoothed profile
  std::size_t crest = 0;       ///< index of the crest's middle
  bool leaves_frame_left = false;
  bool leaves_frame_right = false;
  bool leaves_frame_top = false;

  std::size_t size() const { return along.size(); }
};

Profile upper_profile(const Body& body, const Segmentation& segmentation,
                      const WorkingPicture& work);

/// Finds the crest: the middle of the stretch within 3 % of the top of the lightly smoothed edge.
/// Needs at least one point.
void set_crest(Profile& profile);

/// Moving average over `width` points, narrower near the ends.
std::vector<double> moving_average(const std::vector<double>& values, std::size_t width);

}  // namespace repose::vision
