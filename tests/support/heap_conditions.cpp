#include "tests/support/heap_conditions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "tests/support/heap_draft.h"
#include "tests/support/heap_fit.h"
#include "tests/support/heap_palette.h"
#include "tests/support/heap_random.h"
#include "tests/support/hollow_conditions.h"

namespace repose::testing {
namespace {

HeapScene clean(std::uint64_t seed) { return draft("clean", seed).scene; }

HeapScene inverted_white(std::uint64_t seed) {
  auto [scene, random] = draft("inverted_white", seed);
  scene.grain.color = {0.93, 0.92, 0.89};
  scene.grain.gloss = 0.3;
  scene.grain.elongation = 1.08;
  const double dark = random.uniform(0.04, 0.14);
  scene.around.backdrop = {dark, dark, dark * random.uniform(1, 1.3)};
  const double plate = random.uniform(0.08, 0.45);
  scene.around.plate = {plate, plate, plate};
  return scene;
}

HeapScene asymmetric(std::uint64_t seed) {
  auto [scene, random] = draft("asymmetric", seed);
  choose_angles(scene.form, radians(random.uniform(21, 34)), radians(6), random);
  return scene;
}

HeapScene silhouette(std::uint64_t seed) {
  auto scene = draft("silhouette", seed).scene;
  scene.style = Style::silhouette;
  scene.form.toe_sink = 0;
  scene.camera = Camera{};
  return scene;
}

HeapScene dark(std::uint64_t seed) {
  auto [scene, random] = draft("dark", seed);
  choose_colors(scene, 24, 38, random);
  scene.camera.exposure = random.uniform(0.14, 0.35);
  scene.camera.noise = random.uniform(0.01, 0.018);
  return scene;
}

HeapScene uneven_light(std::uint64_t seed) {
  auto [scene, random] = draft("uneven_light", seed);
  choose_colors(scene, 32, 65, random);
  scene.camera.gradient = random.uniform(0.8, 1.05);
  // Mostly sideways, so that one flank is bright and the other dark.
  scene.camera.gradient_rad =
      random.uniform(-0.6, 0.6) + (random.chance(0.5) ? std::numbers::pi : 0);
  scene.camera.vignette = random.uniform(0.35, 0.55);
  scene.camera.exposure = random.uniform(0.9, 1.1);
  return scene;
}

HeapScene texture(std::uint64_t seed) {
  auto [scene, random] = draft("texture", seed);
  do {
    choose_colors(scene, 32, 65, random);
  } while (scene.around.backdrop.g < 0.3);  // texture is invisible on black
  scene.around.texture = random.pick(std::array{Texture::noise, Texture::fabric, Texture::wood});
  scene.around.texture_strength = random.uniform(0.18, 0.34);
  scene.around.texture_scale = random.uniform(0.5, 1.4);
  return scene;
}

/// A dark heap must still stand out from its own shadow.
HeapScene shadow(std::uint64_t seed) {
  auto [scene, random] = draft("shadow", seed);
  scene.around.shadow = any_side(random);
  scene.around.shadow_strength = random.uniform(0.4, 0.7);
  const double left_over = std::pow(1 - scene.around.shadow_strength, 1 / 2.2);
  Color shaded;
  do {
    choose_colors(scene, 36, 80, random);
    const Color& backdrop = scene.around.backdrop;
    shaded = {backdrop.r * left_over, backdrop.g * left_over, backdrop.b * left_over};
  } while (scene.around.backdrop.g < 0.4 || contrast(scene.grain.color, shaded) < 16);
  return scene;
}

HeapScene reflection(std::uint64_t seed) {
  auto [scene, random] = draft("reflection", seed);
  scene.around.reflection = random.uniform(0.3, 0.7);
  scene.around.ground = random.uniform(0.62, 0.74);
  const double steel = random.uniform(0.3, 0.6);
  scene.around.plate = {steel, steel * 1.01, steel * 1.03};
  return scene;
}

HeapScene cylinder(std::uint64_t seed) {
  auto [scene, random] = draft("cylinder", seed);
  scene.around.tube = random.chance(0.5) ? Tube::steel : Tube::acrylic;
  scene.around.tube_width = random.uniform(0.15, 0.45);
  scene.around.tube_gap = random.chance(0.25) ? random.uniform(0.06, 0.15) : random.uniform(0.3, 1);
  return scene;
}

HeapScene ruler_strays(std::uint64_t seed) {
  auto [scene, random] = draft("ruler_strays", seed);
  scene.form.base = random.uniform(0.45, 0.6);
  scene.form.center = 0.5 + random.uniform(-0.06, 0.06);
  scene.form.strays = random.integer(5, 30);
  scene.around.ruler = any_side(random);
  return scene;
}

HeapScene blur_noise_jpeg(std::uint64_t seed) {
  auto [scene, random] = draft("blur_noise_jpeg", seed);
  scene.camera.blur_px = random.uniform(1.5, 3);
  scene.camera.noise = random.uniform(0.025, 0.05);
  scene.camera.jpeg_quality = random.integer(40, 70);
  return scene;
}

HeapScene small(std::uint64_t seed) {
  auto [scene, random] = draft("small", seed);
  scene.width = random.integer(400, 500);
  scene.height = scene.width * 2 / 3;
  scene.form.base = random.uniform(0.55, 0.75);
  scene.form.center = 0.5 + random.uniform(-0.1, 0.1);
  scene.form.grains_high = random.uniform(15, 25);
  scene.form.roughness = 0.5;
  return scene;
}

HeapScene roll(std::uint64_t seed) {
  auto [scene, random] = draft("roll", seed);
  scene.camera.tilt_rad = radians(random.uniform(1, 2.5) * (random.chance(0.5) ? 1 : -1));
  return scene;
}

HeapScene concave_toe(std::uint64_t seed) {
  auto [scene, random] = draft("concave_toe", seed);
  scene.form.toe_height = random.uniform(0.15, 0.2);
  scene.form.toe_runout = random.uniform(0.12, 0.25);
  scene.form.base = random.uniform(0.45, 0.65);
  scene.form.center = 0.5 + random.uniform(-0.05, 0.05);
  return scene;
}

HeapScene apron(std::uint64_t seed) {
  auto [scene, random] = draft("apron", seed);
  scene.form.apron = random.uniform(0.15, 0.4);
  scene.form.base = random.uniform(0.45, 0.6);
  scene.form.center = 0.5 + random.uniform(-0.05, 0.05);
  scene.form.grains_high = random.uniform(15, 35);
  return scene;
}

HeapScene half_heap(std::uint64_t seed) {
  auto [scene, random] = draft("half_heap", seed);
  lean_on_wall(scene.form, random);
  return scene;
}

HeapScene truncated(std::uint64_t seed) {
  auto [scene, random] = draft("truncated", seed);
  HeapForm& form = scene.form;
  form.base = random.uniform(0.7, 0.9);
  form.cut = any_side(random);
  form.cut_height = random.uniform(0.35, 0.7);
  const double cot_left = 1 / std::tan(form.left_rad);
  const double cot_right = 1 / std::tan(form.right_rad);
  const double height = form.base / (cot_left + cot_right);
  const double hidden = form.cut_height * height;
  form.center = form.cut == Side::left ? form.base / 2 - hidden * cot_left
                                       : 1 - form.base / 2 + hidden * cot_right;
  return scene;
}

HeapScene empty_plate(std::uint64_t seed) {
  auto scene = draft("empty_plate", seed).scene;
  scene.form.shape = Shape::nothing;
  return scene;
}

HeapScene column(std::uint64_t seed) {
  auto [scene, random] = draft("column", seed);
  scene.form.shape = Shape::column;
  scene.form.base = random.uniform(0.2, 0.4);
  scene.form.left_rad = scene.form.right_rad = radians(random.uniform(50, 65));
  return scene;
}

HeapScene ball(std::uint64_t seed) {
  auto [scene, random] = draft("ball", seed);
  scene.form.shape = Shape::ball;
  scene.form.base = random.uniform(0.25, 0.4);
  return scene;
}

HeapScene oblique(std::uint64_t seed) {
  auto [scene, random] = draft("oblique", seed);
  scene.form.shape = Shape::oblique;
  scene.form.elevation_rad = radians(random.uniform(20, 30));
  scene.form.base = random.uniform(0.5, 0.7);
  scene.form.left_rad = scene.form.right_rad = radians(random.uniform(28, 38));
  scene.around.ground = 0.62;
  return scene;
}

HeapScene wall_to_wall(std::uint64_t seed) {
  auto [scene, random] = draft("wall_to_wall", seed);
  scene.form.shape = Shape::layer;
  scene.form.left_rad = scene.form.right_rad = radians(random.uniform(12, 25));
  return scene;
}

constexpr std::array kConditions = {
    Condition{"clean", Group::clean, clean},
    Condition{"inverted_white", Group::clean, inverted_white},
    Condition{"asymmetric", Group::clean, asymmetric},
    Condition{"silhouette", Group::clean, silhouette},
    Condition{"dark", Group::degraded, dark},
    Condition{"uneven_light", Group::degraded, uneven_light},
    Condition{"texture", Group::degraded, texture},
    Condition{"shadow", Group::degraded, shadow},
    Condition{"reflection", Group::degraded, reflection},
    Condition{"cylinder", Group::degraded, cylinder},
    Condition{"ruler_strays", Group::degraded, ruler_strays},
    Condition{"blur_noise_jpeg", Group::degraded, blur_noise_jpeg},
    Condition{"small", Group::degraded, small},
    Condition{"roll", Group::degraded, roll},
    Condition{"concave_toe", Group::degraded, concave_toe},
    Condition{"apron", Group::degraded, apron},
    Condition{"half_heap", Group::degraded, half_heap},
    Condition{"truncated", Group::degraded, truncated},
    Condition{"hollow_power", Group::hollow, hollow_power},
    Condition{"hollow_exponential", Group::hollow, hollow_exponential},
    Condition{"hollow_half_heap", Group::hollow, hollow_half_heap},
    Condition{"hollow_apron", Group::hollow, hollow_apron},
    Condition{"few_grains", Group::hollow, few_grains},
    Condition{"few_grains_hollow", Group::hollow, few_grains_hollow},
    Condition{"hazelnut", Group::sample, hazelnut_scene},
    Condition{"empty_plate", Group::not_measurable, empty_plate},
    Condition{"column", Group::not_measurable, column},
    Condition{"ball", Group::not_measurable, ball},
    Condition{"oblique", Group::not_measurable, oblique},
    Condition{"wall_to_wall", Group::not_measurable, wall_to_wall},
};

}  // namespace

std::span<const Condition> conditions() { return kConditions; }

const Condition& condition_named(std::string_view name) {
  const auto found = std::find_if(kConditions.begin(), kConditions.end(),
                                  [&](const Condition& c) { return c.name == name; });
  if (found != kConditions.end()) return *found;
  throw std::invalid_argument("condition = " + std::string(name) +
                              ", unknown. Fix: take one of draw_heap --list.");
}

HeapScene hazelnut_scene(std::uint64_t seed) {
  auto [scene, random] = draft("hazelnut", seed);
  scene.width = 1200;
  scene.height = 750;
  const double mean = radians(random.normal(23.38, 0.72));
  const double half_difference = radians(random.uniform(-0.8, 0.8));
  scene.form.left_rad = mean + half_difference;
  scene.form.right_rad = mean - half_difference;
  scene.form.base = random.uniform(0.58, 0.68);
  scene.form.center = 0.5 + random.uniform(-0.03, 0.03);
  const double nuts_wide = random.uniform(18, 22);
  scene.form.grains_high = nuts_wide / 2 * std::tan(mean) * (1 - scene.form.crest / 2);
  scene.form.toe_sink = 0.7;
  scene.form.roughness = 0.5;
  scene.grain = {.color = {0.55, 0.33, 0.17},
                 .brightness_spread = 0.1,
                 .hue_spread = 0.03,
                 .size_spread = 0.1,
                 .elongation = 1.3,
                 .gloss = 0.12,
                 .pale_spot = true};
  scene.around.backdrop = {0.80, 0.80, 0.79};
  scene.around.plate = {0.62, 0.63, 0.65};
  scene.around.table = {0.30, 0.29, 0.28};
  settle(scene, random);
  return scene;
}

}  // namespace repose::testing
