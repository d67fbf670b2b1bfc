#include "tests/support/hollow_conditions.h"

#include <array>
#include <cmath>

#include "tests/support/flank_law.h"
#include "tests/support/heap_draft.h"
#include "tests/support/heap_fit.h"

namespace repose::testing {
namespace {

/// The crest is rounded off above the window, so that only the law bends the flank within it.
void hollow_out(HeapForm& form, Flanks flanks, Random& random) {
  choose_angles(form, radians(random.uniform(14, 30)), radians(1.5), random);
  const double chord_slope = std::tan((form.left_rad + form.right_rad) / 2);
  form.flanks = flanks;
  form.hollow = hollow_of_bend(flanks, chord_slope, radians(random.uniform(3.5, 7.5)));
}

Flanks any_law(Random& random) {
  return random.pick(std::array{Flanks::power, Flanks::exponential});
}

/// Rough, but without chance deviations from its flanks: see settle().
void make_of_few_grains(HeapScene& scene, Random& random) {
  scene.form.grains_high = random.uniform(6, 12);
  scene.form.roughness = 1;
  settle(scene, random);
}

}  // namespace

HeapScene hollow_power(std::uint64_t seed) {
  auto [scene, random] = draft("hollow_power", seed);
  hollow_out(scene.form, Flanks::power, random);
  return scene;
}

HeapScene hollow_exponential(std::uint64_t seed) {
  auto [scene, random] = draft("hollow_exponential", seed);
  hollow_out(scene.form, Flanks::exponential, random);
  return scene;
}

HeapScene hollow_half_heap(std::uint64_t seed) {
  auto [scene, random] = draft("hollow_half_heap", seed);
  HeapForm& form = scene.form;
  hollow_out(form, any_law(random), random);
  form.crest = random.uniform(0.01, 0.1);
  lean_on_wall(form, random);
  return scene;
}

HeapScene hollow_apron(std::uint64_t seed) {
  auto [scene, random] = draft("hollow_apron", seed);
  HeapForm& form = scene.form;
  hollow_out(form, any_law(random), random);
  form.apron = random.uniform(0.3, 0.8);
  form.base = random.uniform(0.4, 0.52);
  form.center = 0.5 + random.uniform(-0.03, 0.03);
  form.grains_high = random.uniform(16, 40);
  return scene;
}

HeapScene few_grains(std::uint64_t seed) {
  auto [scene, random] = draft("few_grains", seed);
  make_of_few_grains(scene, random);
  return scene;
}

HeapScene few_grains_hollow(std::uint64_t seed) {
  auto [scene, random] = draft("few_grains_hollow", seed);
  hollow_out(scene.form, any_law(random), random);
  make_of_few_grains(scene, random);
  return scene;
}

}  // namespace repose::testing
