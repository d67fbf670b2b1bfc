#include "tests/support/heap_draft.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/heap_palette.h"

namespace repose::testing {

Side any_side(Random& random) { return random.chance(0.5) ? Side::left : Side::right; }

void choose_angles(HeapForm& form, double mean_rad, double spread_rad, Random& random) {
  form.left_rad = mean_rad + random.uniform(-spread_rad, spread_rad);
  form.right_rad = mean_rad + random.uniform(-spread_rad, spread_rad);
}

void lean_on_wall(HeapForm& form, Random& random) {
  form.shape = Shape::half_heap;
  form.wall = any_side(random);
  form.wall_is_frame = random.chance(0.4);
  form.right_rad = form.left_rad;
  form.base = random.uniform(1.0, 1.4);
  const double apex = form.wall_is_frame ? -0.004 : random.uniform(0.05, 0.15);
  form.center = form.wall == Side::left ? apex : 1 - apex;
  // A high flank must fit into the picture.
  form.base *= std::min(1.0, 0.75 / std::tan(form.left_rad) / 1.4);
}

Draft draft(std::string_view condition, std::uint64_t seed) {
  Draft draft{{}, Random(seed * 0x9E3779B97F4A7C15 ^ hash_of(condition))};
  auto& [scene, random] = draft;
  scene.condition = condition;
  scene.seed = seed ^ hash_of(condition);
  scene.width = random.pick(std::array{1200, 1200, 1200, 900, 1024, 1440, 1600});
  scene.height = static_cast<int>(scene.width * random.pick(std::array{2. / 3, 0.75, 0.625}));

  choose_angles(scene.form, radians(random.uniform(16.5, 38.5)), radians(1.5), random);
  scene.form.base = random.uniform(0.45, 0.75);
  scene.form.center = 0.5 + random.uniform(-0.5, 0.5) * (0.92 - scene.form.base);
  scene.form.grains_high = 15 * std::pow(4, random.uniform(0, 1));
  scene.form.crest = random.uniform(0.14, 0.22);
  choose_colors(scene, 32, 200, random);
  scene.grain.brightness_spread = random.uniform(0.08, 0.22);

  scene.around.ground = random.uniform(0.72, 0.86);
  scene.around.plate_thick = random.uniform(0.02, 0.07);
  scene.camera.tilt_rad = radians(random.uniform(-0.3, 0.3));
  scene.camera.exposure = random.uniform(0.8, 1.05);
  scene.camera.gradient = random.uniform(0.03, 0.15);
  scene.camera.gradient_rad = random.uniform(0, 2 * std::numbers::pi);
  scene.camera.vignette = random.uniform(0.03, 0.15);
  scene.camera.blur_px = random.uniform(0.45, 0.7);
  scene.camera.noise = random.uniform(0.004, 0.012);
  scene.camera.jpeg_quality = random.integer(85, 96);
  return draft;
}

}  // namespace repose::testing
