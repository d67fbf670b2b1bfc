#include "tests/support/heap_surroundings.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/heap_texture.h"

namespace repose::testing {
namespace {

/// Multiplies every pixel's light by 1 + strength * field, never below a tenth.
void modulate(cv::Mat light, const cv::Mat& field, double strength) {
  for (int row = 0; row < light.rows; ++row) {
    for (int column = 0; column < light.cols; ++column) {
      light.at<cv::Vec3f>(row, column) *=
          std::max(0.1F, 1 + static_cast<float>(strength) * field.at<float>(row, column));
    }
  }
}

/// Blends in a flat colour; rows may be fractional.
void fill_rows(Stage& stage, double from, double to, const cv::Vec3f& light) {
  const int last = std::min(stage.light.rows, static_cast<int>(std::ceil(to)));
  for (int row = std::max(0, static_cast<int>(from)); row < last; ++row) {
    const double covered = std::min(row + 1.0, to) - std::max<double>(row, from);
    const auto part = static_cast<float>(std::clamp(covered, 0.0, 1.0));
    for (int column = 0; column < stage.light.cols; ++column) {
      auto& pixel = stage.light.at<cv::Vec3f>(row, column);
      pixel = pixel * (1 - part) + light * part;
    }
  }
}

/// Upright strip whose light depends on the position across it (0 to 1); columns may be fractional.
template <class LightAcross>
void fill_strip(Stage& stage, double left, double right, double top, double bottom, double opacity,
                LightAcross light_across) {
  const int last = std::min(stage.light.cols, static_cast<int>(std::ceil(right)));
  for (int column = std::max(0, static_cast<int>(std::floor(left))); column < last; ++column) {
    const double covered = std::min(column + 1.0, right) - std::max<double>(column, left);
    const auto part = static_cast<float>(opacity * std::clamp(covered, 0.0, 1.0));
    const cv::Vec3f light =
        light_across(std::clamp((column + 0.5 - left) / (right - left), 0., 1.));
    const int end = std::min(stage.light.rows, static_cast<int>(bottom));
    for (int row = std::max(0, static_cast<int>(top)); row < end; ++row) {
      auto& pixel = stage.light.at<cv::Vec3f>(row, column);
      pixel = pixel * (1 - part) + light * part;
    }
  }
}

/// Soft shadow with the heap's own outline, cast sideways and slightly larger or smaller.
void darken_by_shadow(Stage& stage, const HeapScene& scene, const HeapProfile& profile,
                      Random& random) {
  const double sign = scene.around.shadow == Side::left ? -1 : 1;
  const double shift = sign * profile.height_px() * random.uniform(0.35, 0.8);
  const double grow = random.uniform(0.8, 1.1);
  cv::Mat mask = cv::Mat::zeros(stage.light.size(), CV_32F);
  for (int column = 0; column < mask.cols; ++column) {
    const double top = stage.ground_y - grow * profile.height_at(column + 0.5 - shift);
    for (int row = std::max(0, static_cast<int>(top)); row < mask.rows; ++row) {
      mask.at<float>(row, column) = 1;
    }
  }
  const double softness = profile.height_px() * random.uniform(0.03, 0.10);
  cv::GaussianBlur(mask, mask, {}, softness, softness, cv::BORDER_REPLICATE);
  modulate(stage.light, mask, -scene.around.shadow_strength);
}

/// Mirror image of the objects on the plate, fading and blurring downwards.
void mirror_below(Stage& stage, const cv::Vec3f& plate, double strength) {
  const int ground = static_cast<int>(std::lround(stage.ground_y));
  const int rows = std::min(stage.light.rows - ground, ground);
  cv::Mat mirrored;
  cv::flip(stage.light.rowRange(ground - rows, ground), mirrored, 0);
  cv::GaussianBlur(mirrored, mirrored, {5, 9}, 0.9, 1.8);
  for (int row = 0; row < rows; ++row) {
    const double fade = std::exp(-1.2 * row / std::max(1.0, 0.5 * ground));
    const auto part = static_cast<float>(strength * fade);
    for (int column = 0; column < stage.light.cols; ++column) {
      stage.light.at<cv::Vec3f>(ground + row, column) =
          plate * (1 - part) + mirrored.at<cv::Vec3f>(row, column) * part;
    }
  }
}

/// The heap darkens the plate's edge next to it, more on the shadow's side.
void darken_plate(Stage& stage, const HeapScene& scene, const HeapProfile& profile) {
  const double reach = 0.35 * scene.around.plate_thick * stage.light.rows + 1;
  const double shift = scene.around.shadow == Side::none   ? 0
                       : scene.around.shadow == Side::left ? -0.5 * profile.height_px()
                                                           : 0.5 * profile.height_px();
  const double strength = scene.around.shadow == Side::none ? 0.25 : 0.5;
  for (int column = 0; column < stage.light.cols; ++column) {
    const double height =
        std::max(profile.height_at(column + 0.5), profile.height_at(column + 0.5 - shift));
    const double part = strength * std::min(1.0, height / (3 * profile.grain_px()));
    const int from = static_cast<int>(std::ceil(stage.ground_y));
    for (int row = from; row < stage.light.rows; ++row) {
      const double fade = std::exp(-(row - stage.ground_y) / reach);
      stage.light.at<cv::Vec3f>(row, column) *= static_cast<float>(1 - part * fade);
    }
  }
}

}  // namespace

void paint_backdrop(Stage& stage, const HeapScene& scene, const HeapProfile& profile,
                    Random& random) {
  const cv::Vec3f light = light_of(scene.around.backdrop);
  stage.light.setTo(cv::Scalar(light[0], light[1], light[2]));
  const double wide = stage.light.cols;
  modulate(stage.light, smooth_noise(stage.light.size(), wide / 4, wide / 4, random), 0.02);
  if (scene.around.texture != Texture::none) {
    const cv::Mat field = texture_field(scene.around.texture, stage.light.size(),
                                        scene.around.texture_scale * profile.grain_px(), random);
    modulate(stage.light, field, scene.around.texture_strength);
  }
  if (scene.around.shadow != Side::none) darken_by_shadow(stage, scene, profile, random);
}

void paint_tube(Stage& stage, const HeapScene& scene, const HeapProfile& profile) {
  if (scene.around.tube == Tube::none) return;
  const double base = profile.right_toe_x() - profile.left_toe_x();
  const double half = base * scene.around.tube_width / 2;
  const double bottom = stage.ground_y - profile.height_px() * (1 + scene.around.tube_gap);
  const double left = profile.apex_x() - half;
  const double right = profile.apex_x() + half;
  const double rim = std::max(2.0, 0.02 * base);
  if (scene.around.tube == Tube::steel) {
    const auto steel = [](double t) {
      const double curve = std::sqrt(std::max(0.0, 1 - (2 * t - 1) * (2 * t - 1)));
      const double streak =
          std::exp(-std::pow((t - 0.3) / 0.06, 2)) + 0.5 * std::exp(-std::pow((t - 0.8) / 0.03, 2));
      return cv::Vec3f::all(static_cast<float>(0.10 + 0.28 * curve + 0.5 * streak));
    };
    fill_strip(stage, left, right, 0, bottom, 1, steel);
    const auto dark = [&](double t) { return steel(t) * 0.45F; };
    fill_strip(stage, left, right, bottom - rim, bottom, 1, dark);
    return;
  }
  const auto plastic = [](double) { return cv::Vec3f(0.80F, 0.78F, 0.74F); };
  const auto bright = [](double) { return cv::Vec3f(0.95F, 0.94F, 0.9F); };
  const auto dark = [](double) { return cv::Vec3f(0.16F, 0.15F, 0.14F); };
  fill_strip(stage, left, right, 0, bottom, 0.14, plastic);
  const double wall = std::max(2.5, 0.03 * half);
  for (const double edge : {left, right - wall}) {
    fill_strip(stage, edge, edge + wall, 0, bottom, 0.6, dark);
    fill_strip(stage, edge + 0.3 * wall, edge + 0.6 * wall, 0, bottom, 0.8, bright);
  }
  fill_strip(stage, left + 0.5 * half, left + 0.58 * half, 0, bottom, 0.5, bright);
  fill_strip(stage, left, right, bottom - 0.7 * rim, bottom, 0.5, dark);
}

void paint_ruler(Stage& stage, const HeapScene& scene, const HeapProfile& profile, Random& random) {
  if (scene.around.ruler == Side::none) return;
  const bool at_left = scene.around.ruler == Side::left;
  const double picture_width = stage.light.cols - 2 * stage.margin_px;
  const double wide = random.uniform(0.026, 0.036) * picture_width;
  const double room = at_left ? profile.left_toe_x() - stage.margin_px
                              : stage.margin_px + picture_width - profile.right_toe_x();
  const double gap = random.uniform(0.25, 0.6) * std::max(room - wide, 0.0);
  const double left = at_left ? profile.left_toe_x() - gap - wide : profile.right_toe_x() + gap;
  const double top = stage.ground_y - profile.height_px() * random.uniform(1.15, 2.4);
  static const std::array<Color, 3> kColors = {
      {{0.88, 0.75, 0.2}, {0.78, 0.79, 0.8}, {0.93, 0.93, 0.9}}};
  const cv::Vec3f light = light_of(random.pick(kColors));
  fill_strip(stage, left, left + wide, top, stage.ground_y, 1, [&](double) { return light; });

  const double pitch = wide / 7;
  const auto ink = [](double) { return cv::Vec3f::all(0.02F); };
  int tick = 0;
  for (double y = stage.ground_y - pitch; y > top + pitch; y -= pitch) {
    ++tick;
    const double length = wide * (tick % 10 == 0 ? 0.6 : tick % 5 == 0 ? 0.45 : 0.3);
    const double thick = std::max(1.0, 0.18 * pitch);
    fill_strip(stage, left, left + length, y, std::max(y + thick, std::floor(y) + 1), 0.85, ink);
    if (tick % 10 != 0) continue;
    cv::putText(stage.light, std::to_string(tick / 10),
                {static_cast<int>(left + 0.5 * wide), static_cast<int>(y - 2)},
                cv::FONT_HERSHEY_SIMPLEX, wide / 75, {0.02, 0.02, 0.02}, 1, cv::LINE_AA);
  }
}

void paint_walls(Stage& stage, const HeapScene& scene, const HeapProfile& profile) {
  const HeapForm& form = scene.form;
  const double thick = 0.02 * stage.light.cols;
  const double top = stage.ground_y - 1.9 * profile.height_px();
  const auto board = [&](double t) {
    const double edge = t < 0.12 || t > 0.88 ? 0.55 : 1;
    return light_of(scene.around.plate) * static_cast<float>(0.8 * edge);
  };
  const auto stand = [&](double left) {
    fill_strip(stage, left, left + thick, top, stage.ground_y, 1, board);
  };
  if (form.shape == Shape::column) {
    stand(profile.left_toe_x() - thick);
    stand(profile.right_toe_x());
  } else if (form.shape == Shape::half_heap && !form.wall_is_frame) {
    stand(form.wall == Side::left ? profile.apex_x() - thick : profile.apex_x());
  }
}

void paint_ground(Stage& stage, const HeapScene& scene, const HeapProfile& profile,
                  Random& random) {
  const Surroundings& around = scene.around;
  const cv::Vec3f plate = light_of(around.plate);
  if (around.reflection > 0) {
    mirror_below(stage, plate, around.reflection);
  } else {
    const double thick = around.plate_thick * stage.light.rows;
    fill_rows(stage, stage.ground_y, stage.light.rows, plate);
    fill_rows(stage, stage.ground_y, stage.ground_y + 1.2, plate * 1.25F);
    fill_rows(stage, stage.ground_y + thick, stage.light.rows, light_of(around.table));
    fill_rows(stage, stage.ground_y + thick, stage.ground_y + thick + 2, plate * 0.3F);
    darken_plate(stage, scene, profile);
  }
  const int first = std::min(stage.light.rows - 1, static_cast<int>(std::ceil(stage.ground_y)));
  cv::Mat below = stage.light.rowRange(first, stage.light.rows);
  const double streak = 0.1 * stage.light.cols;
  modulate(below, smooth_noise(below.size(), streak, 3, random), 0.04);
}

void paint_table_top(Stage& stage, const HeapScene& scene, Random& random) {
  const double horizon = stage.margin_px + 0.12 * stage.light.rows;
  fill_rows(stage, horizon, stage.light.rows, light_of(scene.around.plate));
  const double wide = stage.light.cols;
  modulate(stage.light, smooth_noise(stage.light.size(), wide / 10, wide / 40, random), 0.04);
}

}  // namespace repose::testing
