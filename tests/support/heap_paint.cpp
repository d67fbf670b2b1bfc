#include "tests/support/heap_paint.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace repose::testing {
namespace {

struct Material {
  cv::Vec3f color;
  cv::Vec3f spot;
  float gloss = 0;
  bool has_spot = false;
};

/// Unit vectors: right, up, towards the camera.
constexpr float kLamp[3] = {-0.40F, 0.62F, 0.675F};
constexpr float kHalfway[3] = {-0.22F, 0.34F, 0.914F};  ///< between lamp and camera
constexpr float kAmbient = 0.30F;

/// Surface light at (u, v) of the unit disc, with axes rotated by (cosine, sine).
cv::Vec3f shade(const Material& material, float u, float v, float cosine, float sine) {
  const float depth = std::sqrt(std::max(0.02F, 1 - u * u - v * v));
  const float right = u * cosine - v * sine;
  const float up = u * sine + v * cosine;
  const float lit = std::max(0.F, right * kLamp[0] + up * kLamp[1] + depth * kLamp[2]);
  const float mirror = std::max(0.F, right * kHalfway[0] + up * kHalfway[1] + depth * kHalfway[2]);
  const float square = mirror * mirror;
  const float fourth = square * square;
  const float shine = material.gloss * fourth * fourth * fourth * fourth * fourth;
  const float spot_u = (u - 0.86F) / 0.34F;
  const float spot_v = v / 0.5F;
  const bool in_spot = material.has_spot && spot_u * spot_u + spot_v * spot_v < 1;
  const cv::Vec3f color = in_spot ? material.spot : material.color;
  return color * (kAmbient + (1 - kAmbient) * lit) + cv::Vec3f::all(shine);
}

/// Calls put(row, column, coverage, u, v) for every pixel the grain covers.
template <class Put>
void cover(const Grain& grain, const Stage& stage, Put put) {
  const double cosine = std::cos(grain.turn_rad);
  const double sine = std::sin(grain.turn_rad);
  const double center_y = stage.ground_y - grain.center.y;
  const double wide = grain.support({1, 0}) + 1;
  const double high = grain.support({0, 1}) + 1;
  const int top = std::max(0, static_cast<int>(center_y - high));
  const int bottom = std::min(stage.light.rows - 1, static_cast<int>(center_y + high));
  const int left = std::max(0, static_cast<int>(grain.center.x - wide));
  const int right = std::min(stage.light.cols - 1, static_cast<int>(grain.center.x + wide));
  for (int row = top; row <= bottom; ++row) {
    const double dy = center_y - (row + 0.5);
    for (int column = left; column <= right; ++column) {
      const double dx = column + 0.5 - grain.center.x;
      const double u = (dx * cosine + dy * sine) / grain.long_axis;
      const double v = (dy * cosine - dx * sine) / grain.short_axis;
      const double radius = std::hypot(u, v);
      const double steepness = std::hypot(u / grain.long_axis, v / grain.short_axis);
      const double inside = steepness > 0 ? (1 - radius) * radius / steepness : 1;
      const double coverage = std::clamp(inside + 0.5, 0.0, 1.0);
      if (coverage > 0) put(row, column, static_cast<float>(coverage), u, v);
    }
  }
}

}  // namespace

cv::Vec3f light_of(const Color& color) {
  const auto channel = [](double value) { return static_cast<float>(std::pow(value, 2.2)); };
  return {channel(color.b), channel(color.g), channel(color.r)};
}

Stage empty_stage(const HeapScene& scene) {
  Stage stage;
  const double reach = std::max(scene.width, scene.height) / 2.0;
  const double sine = std::abs(std::sin(scene.camera.tilt_rad));
  const int margin = static_cast<int>(std::ceil(reach * sine + 4));
  stage.margin_px = margin;
  stage.size = {scene.width + 2 * margin, scene.height + 2 * margin};
  stage.ground_y = margin + scene.around.ground * scene.height;
  return stage;
}

void paint_grains(Stage& stage, const std::vector<Grain>& grains, const GrainLook& look) {
  for (const Grain& grain : grains) {
    Material material;
    material.color = light_of(grain.color);
    material.spot = material.color * 0.35F + cv::Vec3f(0.22F, 0.32F, 0.42F);
    material.gloss = static_cast<float>(look.gloss);
    material.has_spot = look.pale_spot && grain.long_axis < 1.15 * grain.short_axis;
    const auto cosine = static_cast<float>(std::cos(grain.turn_rad));
    const auto sine = static_cast<float>(std::sin(grain.turn_rad));
    cover(grain, stage, [&](int row, int column, float coverage, double u, double v) {
      auto& pixel = stage.light.at<cv::Vec3f>(row, column);
      const cv::Vec3f light =
          shade(material, static_cast<float>(u), static_cast<float>(v), cosine, sine);
      pixel = pixel * (1 - coverage) + light * coverage;
    });
  }
}

void paint_black(Stage& stage, const std::vector<Grain>& grains) {
  for (const Grain& grain : grains) {
    cover(grain, stage, [&](int row, int column, float coverage, double, double) {
      auto& pixel = stage.light.at<cv::Vec3f>(row, column);
      pixel *= 1 - coverage;
    });
  }
}

void paint_core(Stage& stage, const HeapProfile& profile, const Color& color) {
  const cv::Vec3f dark = light_of(color) * 0.25F;
  const double below = 0.8 * profile.grain_px();
  for (int column = 0; column < stage.light.cols; ++column) {
    const double top = profile.height_at(column + 0.5) - below;
    if (top <= 0) continue;
    const int first = std::max(0, static_cast<int>(std::ceil(stage.ground_y - top)));
    const int last = std::min(stage.light.rows, static_cast<int>(stage.ground_y));
    for (int row = first; row < last; ++row) stage.light.at<cv::Vec3f>(row, column) = dark;
  }
}

}  // namespace repose::testing
