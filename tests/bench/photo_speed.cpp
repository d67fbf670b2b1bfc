#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "tests/bench/clock.h"
#include "tests/support/heap_conditions.h"
#include "tests/support/heap_picture.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

namespace repose::bench {
namespace {

using vision::measure_repose_angle;
using vision::read_picture;

constexpr int kBatch = 16;
constexpr double kNoise = 0.016;

/// JPEG files of 12 megapixels each, removed at the end.
class Photographs {
 public:
  explicit Photographs(int count) {
    std::string name = (std::filesystem::temp_directory_path() / "repose-photos-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::invalid_argument(name + ": cannot be made. Fix: set TMPDIR to a writable folder.");
    }
    folder_ = name;
    for (int i = 0; i < count; ++i) {
      auto scene = testing::condition_named("clean").scene(static_cast<unsigned>(i + 1));
      scene.width = 4000;
      scene.height = 3000;
      scene.camera.blur_px = 1.2;
      // Compressed once, by write_picture, with sensor noise: files of about 2 MB, at the small end
      // of what phones write. Smoother pictures would decode faster than real ones.
      scene.camera.jpeg_quality = 0;
      scene.camera.noise = kNoise;
      files_.push_back(folder_ / (std::to_string(i) + ".jpg"));
      vision::write_picture(files_.back(), testing::draw_heap(scene).picture);
    }
  }
  ~Photographs() { std::filesystem::remove_all(folder_); }
  Photographs(const Photographs&) = delete;
  Photographs(Photographs&&) = delete;
  Photographs& operator=(const Photographs&) = delete;
  Photographs& operator=(Photographs&&) = delete;

  const std::filesystem::path& operator[](std::size_t i) const { return files_[i]; }

 private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
};

const Photographs& photographs() {
  static const Photographs files(kBatch);
  return files;
}

void decode(benchmark::State& state) {
  const auto& file = photographs()[0];
  while (state.KeepRunning()) benchmark::DoNotOptimize(read_picture(file));
}

/// Counter `ratio`: total time / decoding time; target <= 3.
void decode_and_measure(benchmark::State& state) {
  const auto& file = photographs()[0];
  double decoding_s = 0;
  double whole_s = 0;
  while (state.KeepRunning()) {
    const auto start = Clock::now();
    const auto picture = read_picture(file);
    decoding_s += seconds_since(start);
    const auto measured = measure_repose_angle(picture);
    whole_s += seconds_since(start);
    if (!measured.angle_rad) state.SkipWithError(measured.reason.c_str());
  }
  state.counters["ratio"] = whole_s / decoding_s;
}

double batch_s(unsigned threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const auto start = Clock::now();
  tbb::parallel_for(std::size_t{0}, std::size_t{kBatch}, [](std::size_t i) {
    benchmark::DoNotOptimize(measure_repose_angle(read_picture(photographs()[i])));
  });
  return seconds_since(start);
}

/// Counter `speed_up`: one thread's time for the batch / that of two.
void batch_on_two_threads(benchmark::State& state) {
  photographs();
  double one_s = 0;
  double two_s = 0;
  while (state.KeepRunning()) {
    one_s += batch_s(1);
    const double two = batch_s(2);
    two_s += two;
    state.SetIterationTime(two);
  }
  state.counters["speed_up"] = one_s / two_s;
}

BENCHMARK(decode)->Name("BM_decode")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(decode_and_measure)
    ->Name("BM_decode_and_measure")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(batch_on_two_threads)
    ->Name("BM_batch_on_two_threads")
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(3);

}  // namespace
}  // namespace repose::bench
