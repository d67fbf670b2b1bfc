// Draws the figures of docs/tutorial.md from a sample photograph, and those of docs/measuring.md
// from drawn silhouettes and a drawn photograph, as repose measure --overlay draws them:
//
// take_figures PHOTOGRAPH FOLDER           writes them
// take_figures PHOTOGRAPH FOLDER --check   compares them with the existing ones
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/heap_picture.h"
#include "tests/support/hollow_conditions.h"
#include "vision/drawing/overlay.h"
#include "vision/measure/hints.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

namespace repose {
namespace {

namespace fs = std::filesystem;

constexpr int kSide_px = 800, kQuality = 80;
constexpr std::size_t kMax_bytes = 150'000;

struct Figure {
  const char* name = "";
  vision::Box part;  ///< of the photograph; empty: all of it
};

std::vector<std::uint8_t> drawn(const vision::Picture& picture, const char* name) {
  const vision::Picture overlay = vision::draw_overlay(
      picture, vision::measure_repose_angle(picture), {.title = name, .excluded = {}});
  return vision::jpeg_of(vision::reduced(overlay, kSide_px), kQuality);
}

vision::Picture part_of(const vision::Picture& photograph, const Figure& figure) {
  const bool is_whole = figure.part.width == 0;
  return is_whole ? photograph : vision::part_of(photograph, figure.part);
}

/// Silhouette of a heap ten grains high, with a bumpy edge and an apron a quarter of its height.
/// @param apron  length / half of the base
vision::Picture heap_with_apron(double apron) {
  constexpr int kWidth = 1000, kBelow = 60;
  constexpr double kHeight = 170, kHalfBase = 300, kGrain = 17;
  vision::Picture picture{.width = kWidth, .height = 300, .bgr = {}};
  picture.bgr.resize(std::size_t{3} * kWidth * 300, 235);
  for (int column = 0; column < kWidth; ++column) {
    const double out = std::abs(column + .5 - kWidth / 2.0);
    const double flank = kHeight * (1 - out / kHalfBase);
    const double foot = out < kHalfBase * (.75 + apron) ? kHeight / 4 : 0;
    const double top = std::max(flank, foot);
    const double bump = .2 * kGrain * std::sin(out * 4 / kGrain);
    const int rows = top > 0 ? static_cast<int>(top + bump) : 0;
    for (int row = picture.height - kBelow - std::max(0, rows); row < picture.height - kBelow;
         ++row) {
      const auto at = std::size_t{3} * static_cast<std::size_t>(row * kWidth + column);
      std::fill_n(picture.bgr.begin() + static_cast<std::ptrdiff_t>(at), 3, std::uint8_t{40});
    }
  }
  return picture;
}

/// A drawn photograph of a heap seven grains high, from which a layer of one or two has run out.
vision::Picture photograph_with_apron() {
  testing::HeapScene scene = testing::hollow_apron(1);
  scene.form.grains_high = 7;
  scene.form.left_rad = scene.form.right_rad = .5;
  const vision::Picture whole = testing::draw_heap(scene).picture;
  return vision::part_of(
      whole,
      {.x = 0, .y = whole.height / 3, .width = whole.width, .height = whole.height * 11 / 20});
}

/// Their mean difference in grey levels; other library versions round a few pixels differently.
double difference(const fs::path& one, const fs::path& other) {
  const vision::Picture a = vision::read_picture(one), b = vision::read_picture(other);
  if (a.width != b.width || a.height != b.height) return 255;
  double sum = 0;
  for (std::size_t k = 0; k < a.bgr.size(); ++k) sum += std::abs(int{a.bgr[k]} - int{b.bgr[k]});
  return sum / static_cast<double>(a.bgr.size());
}

bool write(const fs::path& file, const std::vector<std::uint8_t>& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  if (bytes.size() <= kMax_bytes) return true;
  std::fprintf(stderr, "%s: %zu bytes are too many\n", file.c_str(), bytes.size());
  return false;
}

bool is_fresh(const fs::path& file, const std::vector<std::uint8_t>& bytes) {
  constexpr double kSame = 1;
  const fs::path now = fs::temp_directory_path() / ("repose_" + file.filename().string());
  bool same = write(now, bytes);
  same = same && fs::exists(file) && difference(now, file) < kSame;
  fs::remove(now);
  if (!same) {
    std::fprintf(stderr, "%s is not what would be drawn now. Fix: docs/take_figures\n",
                 file.c_str());
  }
  return same;
}

bool take(const vision::Picture& photograph, const fs::path& folder, bool only_checks) {
  const vision::Box whole{};
  const vision::Box half{
      .x = 0, .y = 0, .width = photograph.width / 2, .height = photograph.height};
  const vision::Box low{.x = 0,
                        .y = photograph.height * 23 / 50,
                        .width = photograph.width,
                        .height = photograph.height * 27 / 50};
  bool is_good = true;
  const auto finish = [&](const char* name, const vision::Picture& picture) {
    const fs::path file = folder / name;
    const std::vector<std::uint8_t> bytes = drawn(picture, name);
    is_good = (only_checks ? is_fresh(file, bytes) : write(file, bytes)) && is_good;
  };
  for (const Figure& figure :
       {Figure{"measured.jpg", whole}, {"half_a_heap.jpg", half}, {"crest_cut_off.jpg", low}}) {
    finish(figure.name, part_of(photograph, figure));
  }
  finish("short_apron.jpg", heap_with_apron(.15));
  finish("long_apron.jpg", heap_with_apron(.8));
  finish("apron.jpg", photograph_with_apron());
  return is_good;
}

}  // namespace
}  // namespace repose

int main(int count, char** words) {
  if (count != 3 && (count != 4 || std::string(words[3]) != "--check")) return 2;
  try {
    return repose::take(repose::vision::read_picture(words[1]), words[2], count == 4) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
