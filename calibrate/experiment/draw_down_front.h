#pragma once

#include <optional>
#include <vector>

#include "dem/experiment/experiment_table.h"
#include "render/scene/scene.h"
#include "vision/drawing/slopes_overlay.h"
#include "vision/picture/picture.h"

/// The front of a draw-down's two boxes at rest, as seen by a level, distant camera, and the
/// measurements in that picture.
namespace repose::calibrate {

struct DrawDownFront {
  vision::Picture picture;  ///< silhouette of the grains
  /// In picture coordinates: upper left, upper right, lower left, lower right.
  std::vector<vision::Slope> slopes;
  /// Mean of the slopes that fall towards the slot, each measured as one flank of a heap whose
  /// crest is at the side wall; std::nullopt if neither can be measured, e.g. if they are nearly
  /// vertical.
  std::optional<double> upper_angle_deg;
  /// Of the heap below, mean of its flanks; std::nullopt without any.
  std::optional<double> lower_angle_deg;
};

/// Draws and measures it: binarised, the upper edge of each slope and of the heap, and the line
/// fitted through it as for photographs, but without their verdict, so that steep and rounded
/// slopes get a number too. Proved by DrawDownFront.* in tests/calibrate/draw_down_front_test.cpp.
/// @throws base::InputError  the scene has no grains.
/// @throws std::runtime_error  this machine cannot draw.
DrawDownFront draw_down_front(render::Scene scene, const dem::BoxesFront& boxes);

}  // namespace repose::calibrate
