#include <cstddef>
#include <cstdlib>

#include <benchmark/benchmark.h>

#include "render/renderer.h"
#include "render/truth.h"
#include "tests/support/nut_heap.h"

namespace {

using repose::render::OrthographicCamera;
using repose::render::PhotoStyle;
using repose::render::PictureSize;
using repose::render::Renderer;
using repose::render::Scene;
using repose::render::Shown;
using repose::render::SilhouetteStyle;

constexpr PictureSize kSize{1920, 1080};

/// The smallest heap of at least so many nuts.
Scene heap_of(int grains) {
  constexpr double kAngle_rad = .45;
  int across = 2;
  Scene scene;
  do {
    scene = repose::testing::nut_heap(++across, kAngle_rad, 1);
  } while (scene.grains.size() < static_cast<std::size_t>(grains));
  return scene;
}

/// Each picture from another side, so that nothing is drawn twice.
void silhouette(benchmark::State& state) {
  const Scene scene = heap_of(static_cast<int>(state.range(0)));
  const auto shown = state.range(1) == 0 ? Shown::mesh : Shown::spheres;
  Renderer renderer;
  double azimuth_rad = 0;
  while (state.KeepRunning()) {
    azimuth_rad += .1;
    benchmark::DoNotOptimize(renderer.draw(scene, OrthographicCamera{.azimuth_rad = azimuth_rad},
                                           kSize, SilhouetteStyle{.shown = shown}));
  }
  state.counters["grains"] = static_cast<double>(scene.grains.size());
}

void truth(benchmark::State& state) {
  const Scene scene = heap_of(static_cast<int>(state.range(0)));
  while (state.KeepRunning()) {
    benchmark::DoNotOptimize(truth_of(scene, OrthographicCamera{}, kSize, Shown::mesh));
  }
}

/// One of the passes that a photo is the mean of, and what is done once for each photo.
void photo(benchmark::State& state) {
  const Scene scene = heap_of(500);
  const auto camera = camera_on({.distance_m = 1.5}, scene, kSize);
  Renderer renderer;
  const PhotoStyle style{.passes = static_cast<int>(state.range(0))};
  while (state.KeepRunning()) {
    benchmark::DoNotOptimize(renderer.draw(scene, camera, kSize, style));
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

int main(int count, char** words) {
  // One core, as the numbers to reach say; the driver looks at this when it starts.
  ::setenv("LP_NUM_THREADS", "0", 0);
  benchmark::Initialize(&count, words);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
