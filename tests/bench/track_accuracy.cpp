// Accuracy of repose track on films with known truth, and how often its intervals contain it: films
// with many settings, encoded as H.264 and read back. They are drawn, with paths by formulas, or
// rendered, with simulated paths.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "tests/bench/benches.h"
#include "tests/bench/median.h"
#include "tests/bench/rendered_films.h"
#include "tests/bench/tilt_accuracy.h"
#include "tests/support/drawn_drop.h"
#include "tests/support/drawn_film_file.h"
#include "tests/support/drawn_roll.h"
#include "tests/support/temporary_folder.h"
#include "vision/track/drop_track.h"
#include "vision/track/roll_track.h"

namespace repose::bench {
namespace {

using testing::DrawnDrop;
using testing::DrawnRoll;
using vision::Bounce;
using vision::DropTrack;
using vision::RollTrack;

/// The result for one film.
struct DropRow {
  DrawnDrop drawn;
  DropTrack track;
};

/// Random settings within the range of films that people take.
DrawnDrop random_drop(double frames_per_s, unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random()) / 4294967296.0;
  };
  DrawnDrop drop{.frames_per_s = frames_per_s, .seconds = 1.6, .seed = seed};
  drop.restitution = between(.3, .85);
  drop.drop_mm = between(180, 270);
  drop.radius_px = between(4, 14);
  drop.release_s = between(.2, .4);
  drop.sideways_px_s = between(-25, 25);
  drop.exposure = between(.05, .8);
  drop.noise = between(1, 4);
  drop.readout_s = between(0, .012);
  drop.roll_rad = between(-.03, .03);
  drop.has_hand = random() % 2 == 0;
  return drop;
}

DropRow row_of(const DrawnDrop& drawn) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "drop.mp4";
  testing::write_film(file, drawn);
  return {drawn, vision::track_drop(file)};
}

void print(double frames_per_s, const std::vector<DropRow>& rows) {
  std::vector<double> first, heights;
  int held = 0, bounces = 0, refused = 0, flagged = 0;
  double worst = 0;
  for (const DropRow& row : rows) {
    flagged += row.track.status == vision::MeasureStatus::flagged ? 1 : 0;
    if (row.track.bounces.empty()) {
      ++refused;
      fmt::print("  refused, seed {}: {}\n", row.drawn.seed, row.track.reason);
      continue;
    }
    const Bounce& bounce = row.track.bounces.front();
    const double error = std::abs(bounce.restitution.value - row.drawn.restitution);
    first.push_back(error);
    worst = std::max(worst, error);
    heights.push_back(std::abs(bounce.drop_mm.value - row.drawn.drop_mm) / row.drawn.drop_mm);
    for (const Bounce& one : row.track.bounces) {
      ++bounces;
      const double off = std::abs(one.restitution.value - row.drawn.restitution);
      held += off <= one.restitution.uncertainty ? 1 : 0;
    }
  }
  if (first.empty()) return;
  std::sort(first.begin(), first.end());
  fmt::print(
      "{:3.0f} frames/s: {} films, {} refused, {} flagged; error of the first restitution: median "
      "{:.4f}, 95 % {:.4f}, worst {:.4f}; drop height: median {:.2f} %; intervals hold {} of {} "
      "bounces ({:.0f} %)\n",
      frames_per_s, rows.size(), refused, flagged, first[first.size() / 2],
      first[std::min(first.size() - 1, first.size() * 95 / 100)], worst, 100 * median(heights),
      held, bounces, 100.0 * held / bounces);
  std::fflush(stdout);
}

DrawnRoll random_roll(double frames_per_s, unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random()) / 4294967296.0;
  };
  DrawnRoll roll{.frames_per_s = frames_per_s, .seconds = 2.4, .seed = seed};
  roll.incline_deg = between(12, 35);
  roll.released_mm = between(70, 110);
  roll.stopped_mm = between(90, 220);
  roll.radius_px = between(5, 14);
  roll.release_s = between(.2, .4);
  roll.roll_s = between(.9, 1.5);
  roll.exposure = between(.05, .8);
  roll.noise = between(1, 4);
  roll.roll_rad = between(-.02, .02);
  roll.has_hand = random() % 2 == 0;
  roll.goes_left = random() % 2 == 0;
  return roll;
}

/// The result for one film of a roll.
struct RollRow {
  DrawnRoll drawn;
  RollTrack track;
};

RollRow roll_row_of(DrawnRoll drawn, bool has_scale) {
  // Without a ruler the point of release must be visible: the grain is held by a card or a thread.
  if (!has_scale) drawn.has_hand = false;
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "roll.mp4";
  testing::write_film(file, drawn);
  // A person points at its marks, to within a pixel or so.
  std::mt19937 random(drawn.seed);
  std::normal_distribution<double> pointing(0, .5);
  const vision::ScaleBar ruler{.line = {{40 + pointing(random), 20}, {440 + pointing(random), 20}},
                               .length_mm = 400 * drawn.mm_per_px};
  vision::TrackOptions options;
  if (has_scale) options.scale = ruler;
  if (!has_scale) options.released_mm = drawn.released_mm;
  return {drawn, track_roll(file, options)};
}

void print(double frames_per_s, bool has_scale, const std::vector<RollRow>& rows) {
  std::vector<double> errors, inclines;
  int held = 0;
  for (const RollRow& row : rows) {
    if (!row.track.has_reading) {
      fmt::print("  refused, seed {}: {}\n", row.drawn.seed, row.track.reason);
      continue;
    }
    const double off = std::abs(row.track.stopped_mm.value - row.drawn.stopped_mm);
    errors.push_back(100 * off / row.drawn.stopped_mm);
    inclines.push_back(std::abs(row.track.incline_deg.value - row.drawn.incline_deg));
    held += off <= row.track.stopped_mm.uncertainty ? 1 : 0;
  }
  if (errors.empty()) return;
  std::sort(errors.begin(), errors.end());
  fmt::print(
      "{:3.0f} frames/s, {}: {} rolls, {} refused; error of the distance: median {:.2f} %, 95 % "
      "{:.2f} %, worst {:.2f} %; of the incline: median {:.2f} degrees; intervals hold {} of {}\n",
      frames_per_s, has_scale ? "by a ruler" : "by the release", rows.size(),
      rows.size() - errors.size(), errors[errors.size() / 2],
      errors[std::min(errors.size() - 1, errors.size() * 95 / 100)], errors.back(),
      median(inclines), held, errors.size());
  std::fflush(stdout);
}

/// This many films, several at a time.
template <typename Made>
auto made(int films, unsigned first_seed, const Made& make) {
  std::vector<decltype(make(first_seed))> rows(static_cast<std::size_t>(films));
  tbb::parallel_for(std::size_t{0}, rows.size(),
                    [&](std::size_t k) { rows[k] = make(first_seed + static_cast<unsigned>(k)); });
  return rows;
}

struct TrackSettings {
  std::string experiment = "drop";
  std::string source = "drawn";
  int films = 40;
  unsigned first_seed = 1;
  std::vector<double> rates = {30, 60, 240};
  bool prints_each = false;
  std::size_t threads = 2;
};

void track_films(const TrackSettings& settings, double frames_per_s) {
  if (settings.source == "rendered") {
    print_rendered_accuracy(settings.experiment, frames_per_s, settings.films, settings.first_seed,
                            settings.prints_each);
    return;
  }
  if (settings.experiment == "tilt") {
    print_tilt_accuracy(frames_per_s, settings.films, settings.first_seed, settings.prints_each);
    return;
  }
  if (settings.experiment == "drop") {
    print(frames_per_s, made(settings.films, settings.first_seed, [&](unsigned seed) {
            return row_of(random_drop(frames_per_s, seed));
          }));
    return;
  }
  for (const bool has_scale : {true, false}) {
    print(frames_per_s, has_scale, made(settings.films, settings.first_seed, [&](unsigned seed) {
            return roll_row_of(random_roll(frames_per_s, seed), has_scale);
          }));
  }
}

}  // namespace

void add_track_accuracy(CLI::App& bench) {
  CLI::App& app =
      *bench.add_subcommand("track_accuracy", "Of repose track on drawn or rendered films");
  const auto settings = std::make_shared<TrackSettings>();
  app.add_option("--experiment", settings->experiment, "drop, roll or tilt")
      ->check(CLI::IsMember({"drop", "roll", "tilt"}));
  app.add_option("--source", settings->source, "films that are drawn, or rendered from simulations")
      ->check(CLI::IsMember({"drawn", "rendered"}));
  app.add_option("--films", settings->films, "films at each frame rate");
  app.add_option("--first-seed", settings->first_seed, "of the first film; the others follow");
  app.add_option("--rates", settings->rates, "frames per second")->delimiter(',');
  app.add_flag("--each", settings->prints_each, "a line for each film of a tilt, or rendered");
  app.add_option("--threads", settings->threads, "films at a time");
  app.callback([settings] {
    const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism,
                                      settings->threads);
    for (const double frames_per_s : settings->rates) track_films(*settings, frames_per_s);
  });
}

}  // namespace repose::bench
