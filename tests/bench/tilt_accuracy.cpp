#include "tests/bench/tilt_accuracy.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "tests/support/drawn_film_file.h"
#include "tests/support/drawn_tilt.h"
#include "tests/support/temporary_folder.h"
#include "vision/track/tilt_track.h"

namespace repose::bench {
namespace {

using testing::DrawnTilt;
using vision::TiltTrack;

struct TiltRow {
  DrawnTilt drawn;
  TiltTrack track;
};

/// Random settings within the range of films that people take.
DrawnTilt random_tilt(double frames_per_s, unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random()) / 4294967296.0;
  };
  const auto one_of = [&](unsigned count) { return random() % count == 0; };
  DrawnTilt tilt{.width = 400, .height = 300, .frames_per_s = frames_per_s, .seed = seed};
  tilt.onset_deg = between(12, 40);
  tilt.rate_deg_s = .5 * std::pow(10, between(0, 1));
  tilt.rest_s = between(.3, 1);
  tilt.slides_with = between(.7, 1);
  tilt.uneven = one_of(2) ? between(0, .15) : 0;
  tilt.mm_per_px = between(.25, .6);
  tilt.radius_px = between(5, 11);
  tilt.bonded = 2 + static_cast<int>(random() % 2);
  tilt.hinge_part = one_of(2) ? between(-.25, -.03) : between(.03, .15);
  tilt.plate_from = tilt.hinge_part > 0 ? tilt.hinge_part - .02 : -.7;
  tilt.plate_to = between(.8, .97);
  tilt.thickness_px = between(4, 16);
  tilt.edge_row = between(.8, .88);
  // People make sure that the grain stays in the picture until it slides.
  constexpr double kAbove_px = 50;
  const double rise_px = tilt.edge_row * tilt.height - kAbove_px;
  const double farthest =
      rise_px / std::tan(tilt.onset_deg * std::numbers::pi / 180) / tilt.width + tilt.hinge_part;
  tilt.grain_part = std::min(between(.35, .6), farthest);
  tilt.has_texture = one_of(2);
  tilt.goes_left = one_of(2);
  tilt.roll_rad = between(-.02, .02);
  tilt.exposure = between(.05, .8);
  tilt.noise = between(1, 4);
  return tilt;
}

TiltRow row_of(const DrawnTilt& drawn) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "tilt.mp4";
  testing::write_film(file, drawn);
  return {drawn, vision::track_tilt(file)};
}

void print_tilt(const TiltRow& row) {
  const TiltTrack& track = row.track;
  fmt::print("  seed {}: {:.2f} at {:.2f}/s, ", row.drawn.seed, row.drawn.onset_deg,
             row.drawn.rate_deg_s);
  if (track.has_reading) {
    fmt::print("read {:.2f} +- {:.2f}, off {:+.2f}; {:.3f} deg, {:.3f} px;", track.angle_deg.value,
               track.angle_deg.uncertainty, track.angle_deg.value - row.drawn.onset_deg,
               track.noise_deg, track.noise_px);
    for (const vision::Warning& warning : track.warnings) fmt::print(" {}", warning.code);
    fmt::print("\n");
  } else {
    fmt::print("refused: {}\n", track.reason);
  }
  std::fflush(stdout);
}

}  // namespace

void print_tilt_accuracy(double frames_per_s, int films, unsigned first_seed, bool prints_each) {
  std::vector<TiltRow> rows(static_cast<std::size_t>(films));
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t k) {
    rows[k] = row_of(random_tilt(frames_per_s, first_seed + static_cast<unsigned>(k)));
    if (prints_each || !rows[k].track.has_reading) print_tilt(rows[k]);
  });
  std::vector<double> errors;
  int held = 0, flagged = 0;
  for (const TiltRow& row : rows) {
    if (!row.track.has_reading) continue;
    const double off = std::abs(row.track.angle_deg.value - row.drawn.onset_deg);
    errors.push_back(off);
    held += off <= row.track.angle_deg.uncertainty ? 1 : 0;
    flagged += row.track.status == vision::MeasureStatus::flagged ? 1 : 0;
  }
  if (errors.empty()) return;
  std::sort(errors.begin(), errors.end());
  fmt::print(
      "{:3.0f} frames/s: {} tilts, {} refused, {} flagged; error of the angle: median {:.3f}, 95 % "
      "{:.3f}, worst {:.3f} degrees; intervals hold {} of {}\n",
      frames_per_s, rows.size(), rows.size() - errors.size(), flagged, errors[errors.size() / 2],
      errors[std::min(errors.size() - 1, errors.size() * 95 / 100)], errors.back(), held,
      errors.size());
  std::fflush(stdout);
}

}  // namespace repose::bench
