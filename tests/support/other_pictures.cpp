#include "tests/support/other_pictures.h"

#include <array>
#include <numbers>

#include "tests/support/heap_camera.h"
#include "tests/support/heap_draft.h"
#include "tests/support/other_kinds.h"

namespace repose::testing {
namespace {

constexpr std::array kKinds = {
    OtherKind{"room", draw_room},
    OtherKind{"staircase", draw_staircase},
    OtherKind{"boxes", draw_boxes},
    OtherKind{"books", draw_books},
    OtherKind{"cloth", draw_cloth},
    OtherKind{"gabled_roof", draw_gabled_roof},
    OtherKind{"tiled_roof", draw_tiled_roof},
    OtherKind{"roof_on_ground", draw_roof_on_ground},
    OtherKind{"pyramid", draw_pyramid},
    OtherKind{"tent", draw_tent},
    OtherKind{"bridge", draw_bridge},
    OtherKind{"mountains", draw_mountains},
    OtherKind{"trees", draw_trees},
    OtherKind{"clouds", draw_clouds},
    OtherKind{"road", draw_road},
    OtherKind{"warning_sign", draw_warning_sign},
    OtherKind{"letters", draw_letters},
    OtherKind{"logo", draw_logo},
    OtherKind{"smooth_wedge", draw_smooth_wedge},
    OtherKind{"patterned_wedge", draw_patterned_wedge},
    OtherKind{"tools", draw_tools},
    OtherKind{"conveyor", draw_conveyor},
    OtherKind{"cone", draw_cone},
    OtherKind{"striped_cone", draw_striped_cone},
    OtherKind{"bottles", draw_bottles},
    OtherKind{"balls", draw_balls},
    OtherKind{"car", draw_car},
    OtherKind{"animal", draw_animal},
    OtherKind{"hand", draw_hand},
};

/// Cameras of all kinds, from good ones to old phones.
HeapScene any_camera(std::string_view kind, std::uint64_t seed, Random& random) {
  HeapScene scene;
  scene.condition = kind;
  scene.seed = seed;
  scene.width = random.pick(std::array{640, 800, 1024, 1280, 1600});
  scene.height = static_cast<int>(scene.width * random.pick(std::array{2. / 3, .75, .625}));
  Camera& camera = scene.camera;
  camera.tilt_rad = radians(random.chance(.7) ? random.uniform(-.5, .5) : random.uniform(-4, 4));
  camera.exposure = random.uniform(.6, 1.1);
  camera.gradient = random.uniform(.02, .5);
  camera.gradient_rad = random.uniform(0, 2 * std::numbers::pi);
  camera.vignette = random.uniform(.02, .3);
  camera.blur_px = random.uniform(.5, 1.8);
  camera.noise = random.uniform(.003, .03);
  camera.jpeg_quality = random.integer(50, 96);
  return scene;
}

}  // namespace

std::span<const OtherKind> other_kinds() { return kKinds; }

vision::Picture draw_other(const OtherKind& kind, std::uint64_t seed) {
  Random random(seed * 0x9E3779B97F4A7C15 ^ hash_of(kind.name));
  const HeapScene scene = any_camera(kind.name, seed, random);
  Canvas canvas(scene, random);
  kind.draw(canvas, random);
  return take_picture(canvas.stage(), scene, random);
}

}  // namespace repose::testing
