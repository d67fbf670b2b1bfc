#pragma once

#include "vision/measure/body.h"
#include "vision/measure/flank.h"
#include "vision/measure/profile.h"
#include "vision/measure/repose_angle.h"
#include "vision/measure/segmentation.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {

/// One segmentation's account of the heap, and how well the picture supports it.
struct Reading {
  Segmentation segmentation;
  Body body;
  Profile profile;
  FlankFit left;
  FlankFit right;
  /// The side that the hints say is a wall: it has no fit.
  std::optional<Side> walled;
  bool is_wall_a_flank = false;  ///< ... although it looks like a flank
  std::optional<double> grain;   ///< working px
  double edge_contrast = 0;      ///< step across the edge / scatter beside it
  double edge_sharpness = 0;  ///< fraction of the step within three pixels: a shadow's edge is soft
  double score = 0;           ///< 0 to 1: boundary times plausibility; 0 if no flank was found

  const FlankFit& flank(Side side) const { return side == Side::left ? left : right; }
  bool has_flank() const {
    return left.status == FlankStatus::ok || right.status == FlankStatus::ok;
  }
  /// Mean of the sides that exist.
  double angle_rad() const;
};

/// The best reading among the segmentation's bodies; score 0 if there is none.
Reading read_heap(const Segmentation& segmentation, const WorkingPicture& work,
                  const MeasureOptions& options);

/// Reads the heap again with another segmentation, on the ground line of an earlier reading.
Reading read_again(const Reading& earlier, const Segmentation& segmentation,
                   const WorkingPicture& work, const MeasureOptions& options);

/// Removes the flank on the side that the hints say is a wall.
void leave_out_wall(Reading& reading, const Hints& hints);

/// Fills in the reading's edge contrast, edge sharpness and score from the picture beside the edge.
void score(Reading& reading, const WorkingPicture& work);

}  // namespace repose::vision
