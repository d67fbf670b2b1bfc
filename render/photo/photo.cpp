#include "render/photo/photo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/gl/lens.h"
#include "render/photo/photo_shaders.h"
#include "render/photo/tone_mapping.h"
#include "render/scene/extent.h"

namespace repose::render {
namespace {

using dem::Vector;

constexpr int kShadowSide = 1024;
/// Half width of the shadow maps in units of Stage::radius_m; a little more than the grains.
constexpr double kMapFraction = 1.1;
/// Offset from a face at which its shadow is looked up, in cells of the map.
constexpr double kShadowShift = 1.5;
constexpr int kKeyUnit = 0, kSkyUnit = 1, kPassUnit = 2;

/// The k-th of evenly spread points in [0, 1)^7. Source: Roberts (2018), The unreasonable
/// effectiveness of quasirandom sequences: multiples of the powers of the root of x^8 = x + 1.
std::array<double, 7> spread_point(int k) {
  constexpr double kRoot = 1.0969815577985598;
  std::array<double, 7> point{};
  double step = 1;
  for (double& coordinate : point) {
    step /= kRoot;
    const double along = .5 + step * k;
    coordinate = along - std::floor(along);
  }
  return point;
}

/// Uniform over a disc of radius 1.
std::array<double, 2> on_disc(double u, double v) {
  const double r = std::sqrt(u), turn = 2 * std::numbers::pi * v;
  return {r * std::cos(turn), r * std::sin(turn)};
}

/// Rows: right, down and away from a light in the direction `to_light`.
Eigen::Matrix3d light_axes(const Vector& to_light) {
  const Vector away = -to_light.normalized();
  const Vector side = std::abs(away.z()) < .9 ? Vector::UnitZ() : Vector::UnitX();
  Eigen::Matrix3d axes;
  axes.row(0) = away.cross(side).normalized();
  axes.row(2) = away;
  axes.row(1) = away.cross(Vector(axes.row(0)));
  return axes;
}

std::array<double, 9> rows_of(const Eigen::Matrix3d& matrix) {
  std::array<double, 9> rows{};
  for (int k = 0; k < 9; ++k) rows[static_cast<std::size_t>(k)] = matrix(k / 3, k % 3);
  return rows;
}

std::array<double, 3> array_of(const Vector& v) { return {v.x(), v.y(), v.z()}; }

/// Height of the table top that everything stands on.
double floor_of(const Scene& scene, const Stage& stage) {
  if (scene.setting) return scene.setting->floor_m;
  const double lowest = grain_bounds(scene, Eigen::Matrix3d::Identity()).min().z();
  const auto ground = ground_m(scene);
  if (!ground) return lowest - .05 * stage.radius_m;
  double floor = *ground - 1e-3 * stage.radius_m;
  for (const PlacedWall& wall : scene.walls) {
    const auto* box = std::get_if<dem::Box>(&wall.shape);
    if (box == nullptr || wall.pose.position.z() > *ground) continue;
    const Eigen::Matrix3d axes = wall.pose.orientation.toRotationMatrix();
    floor = std::min(floor, wall.pose.position.z() - axes.row(2).cwiseAbs().dot(box->half_size));
  }
  return std::min(floor, lowest);
}

/// Position of the backdrop: behind the grains and the boxes that they lie on, close enough that
/// little of the table shows between.
double back_of(const Scene& scene, const Stage& stage, const Vector& into) {
  constexpr double kGap = .25, kFarthest = 4;  // in radii of the grains
  double farthest = stage.radius_m;
  for (const PlacedWall& wall : scene.walls) {
    const auto* box = std::get_if<dem::Box>(&wall.shape);
    if (box == nullptr) continue;
    const Vector own = wall.pose.orientation.conjugate() * into;
    farthest = std::max(
        farthest, into.dot(wall.pose.position - stage.origin) + own.cwiseAbs().dot(box->half_size));
  }
  return std::min(farthest + kGap * stage.radius_m, kFarthest * stage.radius_m);
}

}  // namespace

struct PhotoPainter::Programs {
  explicit Programs(const gl::Functions& gl)
      : body(gl, lens_source() + shaders::body_vertex(), shaders::body_fragment(), kAttributes),
        shadow(gl, shaders::shadow_vertex(), shaders::shadow_fragment(), kAttributes),
        room(gl, shaders::room_vertex(), shaders::room_fragment(), {}),
        add(gl, shaders::add_vertex(), shaders::add_fragment(), {}),
        nothing(gl, std::vector<float>(9), std::vector<std::uint32_t>{0, 1, 2}, {3}) {}

  gl::Program body, shadow, room, add;
  gl::Shape nothing;  ///< a triangle whose vertices the shader generates
};

/// Takes one photograph.
class PhotoPainter::Session {
 public:
  Session(const gl::Functions& gl, const Programs& programs, const Scene& scene, const View& view,
          const std::vector<Stage>& stages, const PhotoStyle& style)
      : gl_(gl),
        programs_(programs),
        view_(view),
        stages_(stages),
        stage_(&stages.front()),
        style_(style),
        floor_m_(floor_of(scene, *stage_) - stage_->origin.z()),
        focus_m_(std::max(view.in_camera(stage_->origin).z(), view.is_perspective ? 1e-6 : 1.0)),
        key_(gl, gl::PixelFormat::shadow, kShadowSide, kShadowSide),
        sky_(gl, gl::PixelFormat::shadow, kShadowSide, kShadowSide),
        pass_(gl, gl::PixelFormat::half_rgba, view.size.width, view.size.height),
        depth_(gl, gl::PixelFormat::depth, view.size.width, view.size.height),
        sum_(gl, gl::PixelFormat::float_rgba, view.size.width, view.size.height),
        key_target_(gl, nullptr, &key_),
        sky_target_(gl, nullptr, &sky_),
        pass_target_(gl, &pass_, &depth_),
        sum_target_(gl, &sum_, nullptr) {
    into_ = Vector(view.axes.row(2));
    into_.z() = 0;
    into_ = into_.norm() > 1e-6 ? into_.normalized() : Vector(Vector::UnitY());
    right_ = into_.cross(Vector::UnitZ());
    back_m_ = back_of(scene, *stage_, into_);
  }

  Light expose() {
    sum_target_.use();
    gl_.ClearColor(0, 0, 0, 0);
    gl_.Clear(GL_COLOR_BUFFER_BIT);
    for (int k = 0; k < style_.passes; ++k) {
      const auto chance = spread_point(k);
      stage_ = &stages_[static_cast<std::size_t>(k) * stages_.size() /
                        static_cast<std::size_t>(style_.passes)];
      set_lights(chance);
      draw_shadows(key_target_, key_axes_);
      draw_shadows(sky_target_, sky_axes_);
      draw_pass(exposure_of(chance));
      add_pass();
    }
    return read_sum();
  }

 private:
  void set_lights(const std::array<double, 7>& chance) {
    const Vector lamp = (-.62 * right_ - .58 * into_ + .80 * Vector::UnitZ()).normalized();
    const Eigen::Matrix3d straight = light_axes(lamp);
    const auto [a, b] = on_disc(chance[0], chance[1]);
    const double radius = std::tan(style_.key_softness_rad);
    key_axes_ =
        light_axes(lamp + radius * (a * Vector(straight.row(0)) + b * Vector(straight.row(1))));
    const double height = std::clamp(chance[2], .03, .999);
    const double turn = 2 * std::numbers::pi * chance[3];
    const double level = std::sqrt(1 - height * height);
    sky_axes_ = light_axes({level * std::cos(turn), level * std::sin(turn), height});
  }

  Exposure exposure_of(const std::array<double, 7>& chance) const {
    // Tent filter of half a pixel to each side: anti-aliased edges.
    const auto tent = [](double u) {
      return u < .5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
    };
    Exposure exposure{.shift_px = {.5 * tent(chance[4]), .5 * tent(chance[5])}};
    if (!view_.is_perspective || style_.passes == 1) return exposure;
    constexpr double kMPerMm = 1e-3;
    const auto [a, b] = on_disc(chance[6], 7 * chance[4] - std::floor(7 * chance[4]));
    exposure.lens_m = {.5 * kMPerMm * style_.aperture_mm * a,
                       .5 * kMPerMm * style_.aperture_mm * b};
    return exposure;
  }

  void draw_shadows(const gl::Target& target, const Eigen::Matrix3d& axes) {
    target.use();
    gl_.Enable(GL_DEPTH_TEST);
    gl_.Disable(GL_BLEND);
    gl_.Clear(GL_DEPTH_BUFFER_BIT);
    programs_.shadow.use();
    programs_.shadow.set("light_axes", rows_of(axes));
    programs_.shadow.set("map_radius", map_radius_m());
    draw_batches(gl_, stage_->grains);
    draw_batches(gl_, stage_->walls);
  }

  double map_radius_m() const { return kMapFraction * stage_->radius_m; }

  void set_lighting(const gl::Program& program) const {
    program.set("key_map", kKeyUnit);
    program.set("sky_map", kSkyUnit);
    program.set("key_axes", rows_of(key_axes_));
    program.set("sky_axes", rows_of(sky_axes_));
    program.set("map_radius", map_radius_m());
    program.set("key_share", style_.key_fraction);
    program.set("shadow_shift", kShadowShift * 2 * map_radius_m() / kShadowSide);
    program.set("floor_z", floor_m_);
  }

  void draw_pass(const Exposure& exposure) {
    pass_target_.use();
    gl_.Enable(GL_DEPTH_TEST);
    gl_.Disable(GL_BLEND);
    gl_.Clear(GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT);
    key_.bind(kKeyUnit);
    sky_.bind(kSkyUnit);
    programs_.body.use();
    set_lens(programs_.body, view_, *stage_, focus_m_, exposure);
    set_lighting(programs_.body);
    draw_bodies(programs_.body);
    programs_.room.use();
    set_lens(programs_.room, view_, *stage_, focus_m_, exposure);
    set_lighting(programs_.room);
    draw_room(programs_.room);
  }

  void draw_bodies(const gl::Program& program) {
    program.set("lens", array_of(view_.eye - stage_->origin));
    program.set("into_picture", array_of(view_.axes.row(2)));
    program.set("has_lens", view_.is_perspective ? 1 : 0);
    program.set("spot", linear(style_.spot));
    program.set("spread", style_.brightness_spread);
    for (const Batch& batch : stage_->grains) {
      const bool is_sphere = batch.kind == Batch::Kind::spheres;
      constexpr Colour kSphereBlue = {.30, .47, .75};
      program.set("is_shell", 1);
      program.set("base", linear(is_sphere ? kSphereBlue : style_.grain));
      program.set("pattern", is_sphere ? 0.0 : style_.pattern);
      program.set("gloss", style_.gloss);
      program.set("blunt_end", array_of(batch.blunt_end));
      draw_batches(gl_, {batch});
    }
    program.set("is_shell", 0);
    program.set("base", linear(style_.plate));
    program.set("gloss", .25);
    draw_batches(gl_, stage_->walls);
  }

  void draw_room(const gl::Program& program) {
    constexpr double kFront = 2.6, kHeight = 3;  // in radii of the grains
    program.set("into_room", array_of(into_));
    program.set("front", -kFront * stage_->radius_m);
    program.set("back", back_m_);
    program.set("before", 2 * kFront * stage_->radius_m);
    program.set("height", kHeight * stage_->radius_m);
    program.set("table", linear(style_.table));
    program.set("backdrop", linear(style_.backdrop));
    gl_.Disable(GL_CULL_FACE);
    programs_.nothing.draw(std::array<float, 1>{0}, {1});
  }

  void add_pass() {
    sum_target_.use();
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_CULL_FACE);
    gl_.Enable(GL_BLEND);
    gl_.BlendFunc(GL_ONE, GL_ONE);
    pass_.bind(kPassUnit);
    programs_.add.use();
    programs_.add.set("pass", kPassUnit);
    programs_.nothing.draw(std::array<float, 1>{0}, {1});
    gl_.Disable(GL_BLEND);
  }

  Light read_sum() {
    Light light{.width = view_.size.width, .height = view_.size.height, .rgb = {}};
    light.rgb.resize(3 * static_cast<std::size_t>(light.width) *
                     static_cast<std::size_t>(light.height));
    sum_target_.use();
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.ReadPixels(0, 0, light.width, light.height, GL_RGB, GL_FLOAT, light.rgb.data());
    const float fraction = 1.0F / static_cast<float>(style_.passes);
    for (float& value : light.rgb) value *= fraction;
    return light;
  }

  const gl::Functions& gl_;
  const Programs& programs_;
  const View& view_;
  const std::vector<Stage>& stages_;
  const Stage* stage_;  ///< of the current pass
  const PhotoStyle& style_;
  double floor_m_, focus_m_, back_m_ = 0;
  gl::Texture key_, sky_, pass_, depth_, sum_;
  gl::Target key_target_, sky_target_, pass_target_, sum_target_;
  Vector into_ = Vector::Zero(), right_ = Vector::Zero();  ///< level
  Eigen::Matrix3d key_axes_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d sky_axes_ = Eigen::Matrix3d::Identity();
};

PhotoPainter::PhotoPainter(const gl::Functions& gl)
    : gl_(gl), programs_(std::make_unique<Programs>(gl)) {}
PhotoPainter::~PhotoPainter() = default;

Light PhotoPainter::paint(const Scene& scene, const View& view, const std::vector<Stage>& stages,
                          const PhotoStyle& style) {
  return Session(gl_, *programs_, scene, view, stages, style).expose();
}

}  // namespace repose::render
