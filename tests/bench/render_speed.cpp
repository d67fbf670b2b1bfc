#include <cstddef>
#include <cstdlib>

#include <benchmark/benchmark.h>

#include "render/renderer.h"
#include "render/truth.h"
#include "tests/support/nut_heap.h"

namespace repose::bench {
namespace {

using render::OrthographicCamera;
using render::PhotoStyle;
using render::PictureSize;
using render::Renderer;
using render::Scene;
using render::Shown;
using render::SilhouetteStyle;

constexpr PictureSize kFullHd{1920, 1080};

/// The smallest heap of at least this many nuts.
Scene heap_of(int grains) {
  constexpr double kAngle_rad = .45;
  int across = 2;
  Scene scene;
  do {
    scene = testing::nut_heap(++across, kAngle_rad, 1);
  } while (scene.grains.size() < static_cast<std::size_t>(grains));
  return scene;
}

/// Each picture from a different side, so that nothing is drawn twice.
void silhouette(benchmark::State& state) {
  const Scene scene = heap_of(static_cast<int>(state.range(0)));
  const auto shown = state.range(1) == 0 ? Shown::mesh : Shown::spheres;
  Renderer renderer;
  double azimuth_rad = 0;
  while (state.KeepRunning()) {
    azimuth_rad += .1;
    benchmark::DoNotOptimize(renderer.draw(scene, OrthographicCamera{.azimuth_rad = azimuth_rad},
                                           kFullHd, SilhouetteStyle{.shown = shown}));
  }
  state.counters["grains"] = static_cast<double>(scene.grains.size());
}

void truth(benchmark::State& state) {
  const Scene scene = heap_of(static_cast<int>(state.range(0)));
  while (state.KeepRunning()) {
    benchmark::DoNotOptimize(truth_of(scene, OrthographicCamera{}, kFullHd, Shown::mesh));
  }
}

/// The passes whose mean is a photo, plus the work done once per photo.
void photo(benchmark::State& state) {
  const Scene scene = heap_of(500);
  const auto camera = camera_on({.distance_m = 1.5}, scene, kFullHd);
  Renderer renderer;
  const PhotoStyle style{.passes = static_cast<int>(state.range(0))};
  while (state.KeepRunning()) {
    benchmark::DoNotOptimize(renderer.draw(scene, camera, kFullHd, style));
  }
}

BENCHMARK(silhouette)
    ->Name("BM_silhouette")
    ->ArgNames({"grains", "spheres"})
    ->Args({5, 0})
    ->Args({500, 0})
    ->Args({500, 1})
    ->Args({5000, 0})
    ->Args({50000, 0})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(truth)->Name("BM_truth")->ArgName("grains")->Arg(500)->Unit(benchmark::kMillisecond);
BENCHMARK(photo)
    ->Name("BM_photo")
    ->ArgName("passes")
    ->Arg(1)
    ->Arg(24)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace repose::bench
