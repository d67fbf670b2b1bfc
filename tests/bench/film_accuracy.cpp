// Accuracy of the angle that repose measure gets from a drawn film, compared with that from a
// single frame of the same film.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "base/units.h"
#include "tests/bench/benches.h"
#include "tests/bench/median.h"
#include "tests/support/drawn_heap_film.h"
#include "tests/support/heap_conditions.h"
#include "tests/support/heap_picture.h"
#include "tests/support/temporary_folder.h"
#include "vision/film/film_angle.h"
#include "vision/video/film_writer.h"

namespace repose::bench {
namespace {

struct HeapFilmRow {
  double truth_deg = 0;
  vision::ReposeAngle film;
  vision::ReposeAngle frame;
};

/// Every second film flickers, every third ends with a hand, every fourth has a timer.
testing::DrawnHeapFilm random_film(std::uint64_t seed, double noise) {
  constexpr std::array kConditions = {"clean", "uneven_light", "texture", "shadow",
                                      "blur_noise_jpeg"};
  constexpr int kWidth = 800;
  testing::HeapScene scene =
      testing::condition_named(kConditions.at(seed % kConditions.size())).scene(seed);
  scene.height = scene.height * kWidth / scene.width / 2 * 2;
  scene.width = kWidth;
  scene.camera.jpeg_quality = 0;
  return {.scene = scene,
          .rests_s = 1.1,
          .hand_s = seed % 3 == 0 ? .3 : 0,
          .noise = noise,
          .flicker = seed % 2 == 0 ? .03 : 0,
          .has_timer = seed % 4 == 0};
}

HeapFilmRow row_of(const testing::DrawnHeapFilm& drawn) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "heap.mp4";
  vision::FilmWriter film(file, drawn.frames_per_s);
  for (const vision::Picture& picture : drawn.pictures()) film.add(picture);
  film.close();
  vision::FilmAngle measured = vision::measure_film(file);
  HeapFilmRow row{.truth_deg = testing::heap_truth(drawn.scene).mean_rad().value_or(0) / kDegree,
                  .film = std::move(measured.heap.angle),
                  .frame = {}};
  vision::FrameSeries series(file, measured.times_s, drawn.grows_s + drawn.rests_s / 2);
  series.next();
  const auto frame = series.next();
  if (frame) row.frame = vision::measure_repose_angle(frame->picture);
  return row;
}

void print(const char* what, const std::vector<HeapFilmRow>& rows,
           vision::ReposeAngle HeapFilmRow::*angle) {
  std::vector<double> errors_deg, widths_deg;
  int held = 0;
  for (const HeapFilmRow& row : rows) {
    const vision::ReposeAngle& measured = row.*angle;
    if (!measured.angle_rad) continue;
    errors_deg.push_back(std::abs(*measured.angle_rad / kDegree - row.truth_deg));
    widths_deg.push_back(measured.uncertainty_rad.value_or(0) / kDegree);
    held += errors_deg.back() <= widths_deg.back() ? 1 : 0;
  }
  if (errors_deg.empty()) return;
  fmt::print(
      "{:12} {:3} films, {} refused: median error {:.3f}, worst {:.3f}, median ± {:.2f}, "
      "{} intervals hold\n",
      what, rows.size(), rows.size() - errors_deg.size(), median(errors_deg),
      *std::max_element(errors_deg.begin(), errors_deg.end()), median(widths_deg), held);
}

struct FilmSettings {
  int films = 30;
  std::uint64_t first_seed = 1;
  std::size_t threads = 2;
  std::vector<double> noises = {8, 25};
};

void measure_films(const FilmSettings& settings) {
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism, settings.threads);
  for (const double noise : settings.noises) {
    std::vector<HeapFilmRow> rows(static_cast<std::size_t>(settings.films));
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t k) {
      rows[k] = row_of(random_film(settings.first_seed + k, noise));
    });
    fmt::print("noise {:g}\n", noise);
    print("at rest", rows, &HeapFilmRow::film);
    print("one frame", rows, &HeapFilmRow::frame);
  }
}

}  // namespace

void add_film_accuracy(CLI::App& bench) {
  CLI::App& app = *bench.add_subcommand("film_accuracy", "Of repose measure on drawn films");
  const auto settings = std::make_shared<FilmSettings>();
  app.add_option("--films", settings->films, "films at each noise");
  app.add_option("--first-seed", settings->first_seed, "of the first film; the others follow");
  app.add_option("--noises", settings->noises, "standard deviations of a grey level")
      ->delimiter(',');
  app.add_option("--threads", settings->threads, "films at a time");
  app.callback([settings] { measure_films(*settings); });
}

}  // namespace repose::bench
