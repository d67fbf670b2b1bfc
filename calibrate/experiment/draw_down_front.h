#pragma once

#include <optional>
#include <vector>

#include "dem/experiment/experiment_table.h"
#include "render/scene/scene.h"
#include "vision/drawing/slopes_overlay.h"
#include "vision/picture/picture.h"

/// The front of a draw-down's two boxes at rest, as a camera sees it that is level and far away,
/// and what is measured in that picture.
namespace repose::calibrate {

struct DrawDownFront {
  vision::Picture picture;  ///< silhouette of the grains
  /// Where they are in the picture: above on the left and on the right, below on the left and
  /// right.
  std::vector<vision::Slope> slopes;
  /// Mean of the slopes that fall towards the slot, each measured as one flank of a heap whose
  /// crest is at the side wall; none when neither can be, as where they stand nearly upright.
  std::optional<double> upper_angle_deg;
  /// Of the heap below, mean of its flanks; none without any.
  std::optional<double> lower_angle_deg;
};

/// Draws and measures it: binarised, the upper edge of each slope and of the heap, and the line
/// through it that photographs are measured with, but without their verdict, so that steep and
/// round slopes have their number too. Proved by DrawDownFront.* in
/// tests/calibrate/draw_down_front_test.cpp.
/// @throws base::InputError  the scene has no grains.
/// @throws std::runtime_error  this machine cannot draw.
DrawDownFront draw_down_front(render::Scene scene, const dem::BoxesFront& boxes);

}  // namespace repose::calibrate
