// Accuracy of lens, pitch, scale and sizes measured from pictures of a printed board, and how often
// their intervals contain the truth.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "base/units.h"
#include "tests/bench/benches.h"
#include "tests/bench/board_subjects.h"
#include "tests/bench/median.h"
#include "vision/camera/sized_heap.h"

namespace repose::bench {
namespace {

using vision::Estimate;

/// Errors of one number over many pictures.
struct Tally {
  std::vector<double> errors;
  std::vector<double> half_widths;
  int missing = 0;

  /// Both divided by `unit`.
  void add(const std::optional<Estimate>& estimate, double truth, double unit) {
    if (!estimate) {
      ++missing;
      return;
    }
    errors.push_back((estimate->value - truth) / unit);
    half_widths.push_back(estimate->uncertainty / unit);
  }
};

void print(const char* what, const Tally& tally) {
  if (tally.errors.empty()) {
    fmt::print("{:34} none of {}\n", what, tally.missing);
    return;
  }
  std::vector<double> sizes;
  int held = 0;
  for (std::size_t i = 0; i < tally.errors.size(); ++i) {
    sizes.push_back(std::abs(tally.errors[i]));
    held += sizes.back() <= tally.half_widths[i] ? 1 : 0;
  }
  fmt::print("{:34} {:9.3f} {:9.3f} {:9.3f} {:9.3f}   {} of {}{}\n", what, median(tally.errors),
             median(sizes), *std::max_element(sizes.begin(), sizes.end()),
             median(tally.half_widths), held, sizes.size(),
             tally.missing > 0 ? fmt::format(", {} missing", tally.missing) : "");
}

void print_heading(const char* what) {
  fmt::print("\n{:34} {:>9} {:>9} {:>9} {:>9}   {}\n", what, "bias", "|error|", "worst", "± x",
             "intervals that hold");
}

std::optional<Estimate> estimate_of(const vision::LensNumber& number) {
  return Estimate{number.value, number.uncertainty};
}

/// The largest distance between a grid's points under the true lens and under its fit, px.
double largest_shift_px(const testing::BoardCamera& camera, const vision::Lens& lens) {
  double largest = 0;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10; ++j) {
      const vision::Point seen{camera.width * i / 10.0, camera.height * j / 10.0};
      const auto truth = camera.direction(seen);
      const vision::Point corrected = lens.corrected(seen);
      // Both without distortion; the fit's own centre and focal length are judged separately.
      const double x = truth.x() * lens.focal_px.value + lens.centre_x_px.value - corrected.x;
      const double y = truth.y() * lens.focal_px.value + lens.centre_y_px.value - corrected.y;
      largest = std::max(largest, std::hypot(x, y));
    }
  }
  return largest;
}

void measure_lenses(int count, int pictures, std::uint64_t first) {
  if (count == 0) return;
  std::vector<vision::LensFit> fits(static_cast<std::size_t>(count));
  tbb::parallel_for(0, count, [&](int i) {
    const std::uint64_t seed = first + static_cast<unsigned>(i);
    fits[static_cast<std::size_t>(i)] =
        vision::fit_lens(board_pictures(any_camera(seed), pictures, seed));
  });
  Tally focal, x, y, k1;
  std::vector<double> shifts, errors;
  int refused = 0, flagged = 0;
  for (int i = 0; i < count; ++i) {
    const vision::LensFit& fit = fits[static_cast<std::size_t>(i)];
    const testing::BoardCamera camera = any_camera(first + static_cast<unsigned>(i));
    if (fit.status == vision::MeasureStatus::refused) {
      ++refused;
      fmt::print("refused: {}\n", fit.reason);
      continue;
    }
    flagged += fit.status == vision::MeasureStatus::flagged ? 1 : 0;
    focal.add(estimate_of(fit.lens.focal_px), camera.focal_px, camera.focal_px / 100);
    x.add(estimate_of(fit.lens.centre_x_px), camera.centre_x_px, 1);
    y.add(estimate_of(fit.lens.centre_y_px), camera.centre_y_px, 1);
    const double side = .5 * camera.width / camera.focal_px;
    // k1 and k2 trade off: k1 is judged only if neither side has k2.
    if (camera.k2 == 0 && fit.lens.k2.value == 0) {
      k1.add(estimate_of(fit.lens.k1), camera.k1, .01 / (side * side));
    }
    shifts.push_back(largest_shift_px(camera, fit.lens));
    errors.push_back(*fit.error_px);
  }
  fmt::print("\n{} lenses of {} pictures each: {} refused, {} flagged\n", count, pictures, refused,
             flagged);
  print_heading("lens");
  print("focal length [%]", focal);
  print("centre, x [px]", x);
  print("centre, y [px]", y);
  print("k1 [% at the picture's side]", k1);
  if (shifts.empty()) return;
  fmt::print(
      "correction in the picture: worst place {:.2f} px in the median, {:.2f} px at most; "
      "reprojection {:.3f} px\n",
      median(shifts), *std::max_element(shifts.begin(), shifts.end()), median(errors));
}

/// The lens as a fit would give it: known to half a percent.
vision::Lens lens_of(const testing::BoardCamera& camera) {
  return {.width = camera.width,
          .height = camera.height,
          .focal_px = {camera.focal_px, .004 * camera.focal_px},
          .centre_x_px = {camera.centre_x_px, 2},
          .centre_y_px = {camera.centre_y_px, 2},
          .k1 = {camera.k1, 0},
          .k2 = {camera.k2, 0},
          .p1 = {},
          .p2 = {},
          .k3 = {}};
}

/// A way to measure a picture.
struct Way {
  const char* name = "";
  bool has_lens = true;
  bool has_bar = false;  ///< two points instead of the board, and a given pitch
};

vision::SizedHeap measured(const HeapWithBoard& heap, const Way& way) {
  vision::ScaleOptions scale{.lens = {},
                             .finds_board = true,
                             .square_mm = heap.square_mm,
                             .board_offset_mm = heap.board_offset_mm,
                             .scale = {}};
  if (way.has_lens) scale.lens = lens_of(heap.camera);
  if (!way.has_bar) return vision::measure_sized_heap(heap.picture, {}, scale);
  scale.finds_board = false;
  scale.scale = heap.bar;
  vision::MeasureOptions options;
  options.excluded = {heap.board_box};
  options.camera_pitch_rad = heap.pitch_rad;
  return vision::measure_sized_heap(heap.picture, options, scale);
}

struct HeapTallies {
  Tally scale, pitch, roll, height, base, volume;
  int refused = 0;

  void add(const vision::SizedHeap& heap, const HeapWithBoard& truth) {
    if (heap.angle.status == vision::MeasureStatus::refused) {
      ++refused;
      return;
    }
    const auto part = [](Tally& tally, const std::optional<Estimate>& estimate, double value) {
      tally.add(estimate, value, value / 100);
    };
    if (heap.board) pitch.add(heap.board->pitch_rad, truth.pitch_rad, kDegree);
    if (heap.board) roll.add(heap.board->roll_rad, truth.roll_rad, kDegree);
    part(scale, heap.sizes.mm_per_px, truth.mm_per_px);
    part(height, heap.sizes.height_mm, truth.height_mm);
    part(base, heap.sizes.base_mm, truth.base_mm);
    part(volume, heap.sizes.cone_volume_ml,
         std::numbers::pi / 12e3 * truth.base_mm * truth.base_mm * truth.height_mm);
  }

  void print(const char* name, int count) const {
    fmt::print("\n{}: {} heaps, {} refused\n", name, count, refused);
    print_heading("");
    bench::print("mm per pixel [%]", scale);
    if (pitch.missing + pitch.errors.size() > 0) bench::print("pitch [°]", pitch);
    if (!roll.errors.empty()) bench::print("roll [°]", roll);
    bench::print("height [%]", height);
    bench::print("base [%]", base);
    bench::print("cone's volume [%]", volume);
  }
};

/// Every picture is drawn once and measured in all ways.
void measure_heaps(bool stands_behind, const std::vector<Way>& ways, int count, std::uint64_t first,
                   const std::string& folder) {
  std::vector<HeapWithBoard> truths(static_cast<std::size_t>(count));
  std::vector<std::vector<vision::SizedHeap>> heaps(truths.size());
  tbb::parallel_for(std::size_t{0}, truths.size(), [&](std::size_t i) {
    HeapWithBoard& truth = truths[i];
    truth = heap_with_board(first + i, stands_behind);
    for (const Way& way : ways) {
      heaps[i].push_back(measured(truth, way));
      heaps[i].back().corrected = {};
    }
    if (!folder.empty()) {
      vision::write_picture(std::filesystem::path(folder) / fmt::format("{}.png", first + i),
                            truth.picture);
    }
    truth.picture = {};
  });
  for (std::size_t k = 0; k < ways.size(); ++k) {
    HeapTallies tallies;
    for (std::size_t i = 0; i < truths.size(); ++i) tallies.add(heaps[i][k], truths[i]);
    tallies.print(ways[k].name, count);
  }
}

struct BoardSettings {
  int lenses = 60;
  int heaps = 60;
  int pictures = 10;
  std::uint64_t seed = 1;
  std::string folder;
};

void measure_boards(const BoardSettings& settings) {
  measure_lenses(settings.lenses, settings.pictures, settings.seed);
  if (settings.heaps == 0) return;
  measure_heaps(false,
                {{.name = "board in the heap's plane, known lens"},
                 {.name = "board in the heap's plane, no lens", .has_lens = false},
                 {.name = "two points and pitch, known lens", .has_bar = true},
                 {.name = "two points and pitch, no lens", .has_lens = false, .has_bar = true}},
                settings.heaps, settings.seed, settings.folder);
  measure_heaps(true, {{.name = "board behind the heap, known lens"}}, settings.heaps,
                settings.seed, "");
}

}  // namespace

void add_board_accuracy(CLI::App& bench) {
  CLI::App& app =
      *bench.add_subcommand("board_accuracy", "How near numbers from a printed board come");
  const auto settings = std::make_shared<BoardSettings>();
  app.add_option("--lenses", settings->lenses, "Lenses to fit");
  app.add_option("--pictures", settings->pictures, "Pictures of each");
  app.add_option("--heaps", settings->heaps, "Heaps to measure in each way");
  app.add_option("--seed", settings->seed, "The first");
  app.add_option("--write", settings->folder, "Folder for the pictures of heaps");
  app.callback([settings] { measure_boards(*settings); });
}

}  // namespace repose::bench
