#include "render/renderer.h"

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "render/gl/context.h"
#include "render/gl/scene_uploader.h"
#include "render/photo/photo.h"
#include "render/photo/tone_mapping.h"
#include "render/scene/view.h"
#include "render/silhouette/mask.h"
#include "render/silhouette/occlusion.h"
#include "render/silhouette/silhouette.h"

namespace repose::render {

namespace {

/// @throws base::InputError
void check(const PhotoStyle& style) {
  const auto require = [](const char* name, double value, double least, double most) {
    if (value >= least && value <= most) return;
    throw base::InputError({.where = "photo",
                            .subject = name,
                            .value = fmt::format("is {:g}", value),
                            .rule = fmt::format("from {:g} to {:g}", least, most),
                            .fix = "leave it as it is."});
  };
  for (const Colour& colour : {style.grain, style.spot, style.plate, style.table, style.backdrop}) {
    for (const double channel : colour) require("a colour's channel", channel, 0, 1);
  }
  require("brightness_spread", style.brightness_spread, 0, 1);
  require("pattern", style.pattern, 0, 2);
  require("gloss", style.gloss, 0, 1);
  require("key_softness_rad", style.key_softness_rad, 0, 1);
  require("key_fraction", style.key_fraction, 0, 1);
  require("aperture_mm", style.aperture_mm, 0, 1000);
  require("blur_px", style.blur_px, 0, 100);
  require("noise", style.noise, 0, 1);
  require("vignette", style.vignette, 0, 1);
  require("passes", style.passes, 1, kMaxPasses);
}

}  // namespace

class Renderer::Studio {
 public:
  Studio() : gl_(context_.use()), hand_(gl_), mask_(gl_) { context_.release(); }
  ~Studio() { context_.use(); }
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;
  Studio(Studio&&) = delete;
  Studio& operator=(Studio&&) = delete;

  Rendered draw(const Scene& scene, const Camera& camera, const PictureSize& size,
                const Style& style) {
    const View view = view_of(scene, camera, size);
    const InUse in_use(context_);
    if (const auto* silhouette = std::get_if<SilhouetteStyle>(&style)) {
      Rendered rendered{.picture = {}, .grain_mask = silhouette_mask(scene, view, *silhouette)};
      rendered.picture = silhouette_of(scene, view, *silhouette, rendered.grain_mask);
      return rendered;
    }
    const auto& photo = std::get<PhotoStyle>(style);
    check(photo);
    const Stage stage = hand_.set(scene, view, photo.shown, photo.seed);
    // Most users never take a photo: its shaders are compiled on demand.
    if (!photo_) photo_ = std::make_unique<PhotoPainter>(gl_);
    return {.picture = tone_mapped(photo_->paint(scene, view, {stage}, photo), photo),
            .grain_mask = mask_.paint(view, stage)};
  }

  vision::Picture expose(const std::vector<Scene>& moments, const Camera& camera,
                         const PictureSize& size, const PhotoStyle& style) {
    if (moments.empty())
      throw base::InputError({.where = "photo", .value = "nothing is exposed", .fix = "a scene."});
    const View view = view_of(moments.front(), camera, size);
    const InUse in_use(context_);
    check(style);
    std::vector<Stage> stages;
    stages.reserve(moments.size());
    for (const Scene& moment : moments) {
      stages.push_back(hand_.set(moment, view, style.shown, style.seed));
    }
    if (!photo_) photo_ = std::make_unique<PhotoPainter>(gl_);
    return tone_mapped(photo_->paint(moments.front(), view, stages, style), style);
  }

 private:
  std::vector<std::uint8_t> silhouette_mask(const Scene& scene, const View& view,
                                            const SilhouetteStyle& style) {
    Scene grains{.shapes = scene.shapes, .grains = scene.grains, .walls = {}};
    if (view.is_perspective) {
      return mask_.paint_grains(view, hand_.set(grains, view, style.shown, 0));
    }
    Occlusion occlusion = occluded_part(scene, view, style.shown);
    if (occlusion.visible.empty()) return std::move(occlusion.mask);
    grains.grains = std::move(occlusion.visible);
    const Stage stage = hand_.set(grains, view, style.shown, 0);
    std::vector<std::uint8_t> mask = mask_.paint_uncovered(view, stage, occlusion.covered);
    std::transform(mask.begin(), mask.end(), occlusion.mask.begin(), mask.begin(), std::bit_or<>());
    return mask;
  }

  /// The context is this thread's only while something is drawn.
  class InUse {
   public:
    explicit InUse(gl::Context& context) : context_(context) { context_.use(); }
    ~InUse() { context_.release(); }
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;
    InUse(InUse&&) = delete;
    InUse& operator=(InUse&&) = delete;

   private:
    gl::Context& context_;
  };

  gl::Context context_;
  const gl::Functions& gl_;
  SceneUploader hand_;
  MaskPainter mask_;
  std::unique_ptr<PhotoPainter> photo_;
};

Renderer::Renderer() : studio_(std::make_unique<Studio>()) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Rendered Renderer::draw(const Scene& scene, const Camera& camera, const PictureSize& size,
                        const Style& style) {
  return studio_->draw(scene, camera, size, style);
}

vision::Picture Renderer::expose(const std::vector<Scene>& moments, const Camera& camera,
                                 const PictureSize& size, const PhotoStyle& style) {
  return studio_->expose(moments, camera, size, style);
}

}  // namespace repose::render
