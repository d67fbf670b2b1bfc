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
  /// One byte per pixel, rows from the top: 255 if the pixel's centre shows a grain, else 0.
  std::vector<std::uint8_t> grain_mask;
};

/// Renders scenes off-screen, on the CPU.
///
/// The same scene, camera, size and style give the same bytes on the same kind of CPU, whatever the
/// driver's number of threads. (Another CPU may round differently: some edge pixels change.) Use
/// one object in one thread at a time; several objects in several threads are fine.
class Renderer {
 public:
  /// @throws std::runtime_error  no off-screen OpenGL context is available.
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// @throws base::InputError  invalid picture size or camera parameters, a camera inside the heap,
  /// a scene without grains.
  Rendered draw(const Scene& scene, const Camera& camera, const PictureSize& size,
                const Style& style);

  /// A photo of grains that move while it is exposed.
  /// @param moments  of one scene, evenly spread over the exposure, with the same setting; at least
  ///   one; at most as many as the style has passes are used
  /// @throws base::InputError  as draw(), or without moments.
  vision::Picture expose(const std::vector<Scene>& moments, const Camera& camera,
                         const PictureSize& size, const PhotoStyle& style);

 private:
  class Studio;
  std::unique_ptr<Studio> studio_;
};

}  // namespace repose::render
