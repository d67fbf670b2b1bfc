// How near repose track drop comes to what is known of drawn films, and how often its intervals
// hold: films with many settings, written as H.264 and read again.
//
//   track_accuracy [--films 40] [--first-seed 1] [--rates 30,60,240] [--threads N]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "render/film/film.h"
#include "tests/bench/median.h"
#include "tests/support/drawn_drop.h"
#include "tests/support/temporary_folder.h"
#include "vision/track/drop_track.h"

namespace {

using repose::testing::DrawnDrop;
using repose::vision::Bounce;
using repose::vision::DropTrack;

/// What a film gave.
struct Row {
  DrawnDrop drawn;
  DropTrack track;
};

/// Somewhere within the settings of films that people take.
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
  drop.lean_rad = between(-.03, .03);
  drop.has_hand = random() % 2 == 0;
  return drop;
}

Row row_of(const DrawnDrop& drawn) {
  const repose::testing::TemporaryFolder folder;
  const auto file = folder.path() / "drop.mp4";
  repose::render::Film film(file, drawn.frames_per_s);
  for (int frame = 0; frame < drawn.frames(); ++frame) film.add(drawn.picture(frame));
  film.close();
  return {drawn, repose::vision::track_drop(file)};
}

void print(double frames_per_s, const std::vector<Row>& rows) {
  std::vector<double> first, heights;
  int held = 0, bounces = 0, refused = 0, flagged = 0;
  double worst = 0;
  for (const Row& row : rows) {
    flagged += row.track.status == repose::vision::MeasureStatus::flagged ? 1 : 0;
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
      first[std::min(first.size() - 1, first.size() * 95 / 100)], worst,
      100 * repose::bench::median(heights), held, bounces, 100.0 * held / bounces);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Accuracy of repose track on drawn films");
  int films = 40;
  unsigned first_seed = 1;
  std::size_t threads = 2;
  app.add_option("--films", films, "films at each frame rate");
  app.add_option("--first-seed", first_seed, "of the first film; the others follow");
  std::vector<double> rates = {30, 60, 240};
  app.add_option("--rates", rates, "frames per second")->delimiter(',');
  app.add_option("--threads", threads, "films at a time");
  CLI11_PARSE(app, argc, argv);
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism, threads);
  for (const double frames_per_s : rates) {
    std::vector<Row> rows(static_cast<std::size_t>(films));
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t k) {
      rows[k] = row_of(random_drop(frames_per_s, first_seed + static_cast<unsigned>(k)));
    });
    print(frames_per_s, rows);
  }
}
