#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "render/scene/style.h"
#include "vision/picture/picture.h"

namespace repose::render {

struct Rendered {
  vision::Picture picture;
  /// A byte a pixel, rows from the top: 255 where the pixel's middle shows a grain, else 0.
  std::vector<std::uint8_t> grain_mask;
};

/// Draws scenes off the screen, on the processor.
///
/// Same scene, camera, size and style: same bytes, at any number of threads of the driver, on the
/// same kind of processor. (Another one may round differently: some edge pixels change.) Use one
/// object in one thread at a time; several objects in several threads are fine.
class Renderer {
 public:
  /// @throws std::runtime_error  the machine's OSMesa cannot draw.
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// @throws base::InputError  the picture cannot be taken: its size, the camera's numbers, a
  /// camera inside the heap, a scene without grains.
  Rendered draw(const Scene& scene, const Camera& camera, const PictureSize& size,
                const Style& style);

  /// A photo of grains that move while it is exposed.
  /// @param moments  of one scene, evenly spread over the exposure, with one setting; at least one,
  ///   and no more than the style's passes are seen
  /// @throws base::InputError  as draw(), or without moments.
  vision::Picture expose(const std::vector<Scene>& moments, const Camera& camera,
                         const PictureSize& size, const PhotoStyle& style);

 private:
  class Studio;
  std::unique_ptr<Studio> studio_;
};

}  // namespace repose::render
