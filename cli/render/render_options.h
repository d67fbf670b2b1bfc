#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "cli/common/command.h"
#include "cli/render/render.h"
#include "render/run/filmed_run.h"
#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "render/scene/style.h"

namespace repose::cli {

/// Maps the fields named in library errors to options.
inline constexpr std::array kRenderFields{base::FieldName{"picture size", "--size"},
                                          kPositionFields[0],
                                          kPositionFields[1],
                                          kPositionFields[2],
                                          kPositionFields[3],
                                          kPositionFields[4]};

/// A lens on a stand, from --camera.
struct LensPlan {
  render::LabStand stand;
  double roll_rad = 0;
  double k1 = 0;
  double k2 = 0;
};

enum class RenderOutput { picture, model, film };

/// A parsed `repose render` command.
struct RenderPlan {
  RenderOutput output = RenderOutput::picture;
  bool is_series = false;  ///< the state is a trajectory
  calibrate::PositionsOptions positions;
  render::OrthographicCamera level;
  std::optional<LensPlan> lens;  ///< instead of `level`
  render::PictureSize size;
  render::Style style;
  int turntable_frames = 0;
  std::optional<render::Shutter> shutter;  ///< std::nullopt: a frame for each state of a trajectory
  std::vector<std::string> errors;         ///< all errors; empty: it can be carried out
};

/// The plan's camera, placed in front of a scene.
/// @throws base::InputError  see render::camera_on().
render::Camera camera_of(const RenderPlan& plan, const render::Scene& scene);

RenderPlan plan_render(const RenderArguments& arguments);

Command render_command();

}  // namespace repose::cli
