#pragma once

#include <memory>
#include <vector>

#include "render/gl/objects.h"
#include "render/gl/scene_uploader.h"
#include "render/photo/tone_mapping.h"
#include "render/scene/scene.h"
#include "render/scene/style.h"
#include "render/scene/view.h"

namespace repose::render {

/// Lights a stage like a laboratory, and exposes it through a lens.
///
/// The picture is the mean of several passes, each with a different point of the lamp, direction of
/// ambient light, point of the lens and position within the pixel: this yields soft shadows, dark
/// gaps between grains, depth of field, smooth edges and motion blur.
class PhotoPainter {
 public:
  explicit PhotoPainter(const gl::Functions& gl);
  ~PhotoPainter();
  PhotoPainter(const PhotoPainter&) = delete;
  PhotoPainter& operator=(const PhotoPainter&) = delete;
  PhotoPainter(PhotoPainter&&) = delete;
  PhotoPainter& operator=(PhotoPainter&&) = delete;

  /// @param stages  the scene during the exposure, in order; at least one
  Light paint(const Scene& scene, const View& view, const std::vector<Stage>& stages,
              const PhotoStyle& style);

 private:
  class Session;
  struct Programs;
  const gl::Functions& gl_;
  std::unique_ptr<Programs> programs_;
};

}  // namespace repose::render
