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

/// Lights a stage as a laboratory's is lit, and exposes it through a lens.
///
/// The picture is the mean of several, each with another point of the lamp, another direction of
/// the light from all around, another point of the lens and another part of a pixel: soft shadows,
/// dark gaps between grains, depth of field and smooth edges all come from that, and so does what
/// moves while the picture is exposed.
class PhotoPainter {
 public:
  explicit PhotoPainter(const gl::Functions& gl);
  ~PhotoPainter();
  PhotoPainter(const PhotoPainter&) = delete;
  PhotoPainter& operator=(const PhotoPainter&) = delete;
  PhotoPainter(PhotoPainter&&) = delete;
  PhotoPainter& operator=(PhotoPainter&&) = delete;

  /// @param stages  the scene while it is exposed, one after the other; at least one
  Light paint(const Scene& scene, const View& view, const std::vector<Stage>& stages,
              const PhotoStyle& style);

 private:
  class Session;
  struct Programs;
  const gl::Functions& gl_;
  std::unique_ptr<Programs> programs_;
};

}  // namespace repose::render
