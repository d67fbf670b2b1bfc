#include "tests/bench/rendered_films.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "base/units.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "render/renderer.h"
#include "render/run/filmed_run.h"
#include "tests/support/temporary_folder.h"
#include "vision/track/drop_track.h"
#include "vision/track/roll_track.h"
#include "vision/track/tilt_track.h"
#include "vision/video/film_writer.h"

namespace repose::bench {
namespace {

/// A value read from a film of a run: one per film, or for a drop one per bounce.
struct Reading {
  double truth = 0;
  vision::Estimate read;
};

struct FilmRow {
  unsigned seed = 0;
  std::string setting;
  std::string reason = {};  ///< why there is no reading
  bool is_flagged = false;
  std::vector<Reading> readings = {};
};

class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  double between(double least, double most) {
    return least + (most - least) * static_cast<double>(random_()) / 4294967296.0;
  }
  bool one_of(unsigned count) { return random_() % count == 0; }
  /// Error of a person's pointing: a pixel or so.
  double pointing_px() { return std::normal_distribution<double>(0, .5)(random_); }

 private:
  std::mt19937 random_;
};

/// Three spheres in a row.
dem::ClumpShape clump_of(double radius_m) {
  dem::ClumpShape shape;
  const double step = .45 * radius_m, end = .85 * radius_m;
  shape.spheres = {{.centre = {-step, 0, 0}, .radius = end},
                   {.centre = {0, 0, 0}, .radius = radius_m},
                   {.centre = {step, 0, 0}, .radius = end}};
  const double half = step + end;
  shape.volume_m3 = 4. / 3 * std::numbers::pi * half * radius_m * radius_m;
  shape.gyration_m2 = dem::Vector(2 * radius_m * radius_m, half * half + radius_m * radius_m,
                                  half * half + radius_m * radius_m) /
                      5;
  return shape;
}

dem::Model model_of(Chance& chance, bool is_clump) {
  dem::Model model;
  const double radius_m = chance.between(2.5e-3, 5e-3);
  model.grain = is_clump ? clump_of(radius_m) : dem::sphere_shape(radius_m);
  model.grain_material = {"grain", 1200, 1e8, .3};
  model.wall_material = {"plate", 2700, 1e10, .3};
  model.grain_wall = {chance.between(.3, .85), chance.between(.25, .8), .03};
  model.grain_grain = model.grain_wall;
  return model;
}

/// The states of a run, kept in memory.
class Recorder {
 public:
  dem::RunRecord record(double interval_s) {
    dem::RunRecord record;
    record.frame_interval_s = interval_s;
    record.frame = [this](const dem::Simulation& simulation) {
      times_s_.push_back(simulation.time_s());
      scenes_->push_back(render::scene_of(simulation));
    };
    return record;
  }
  render::RunStates states() const {
    return {.times_s = times_s_,
            .scene = [scenes = scenes_](std::size_t number) { return (*scenes)[number]; }};
  }
  const std::vector<render::Scene>& scenes() const { return *scenes_; }

 private:
  std::vector<double> times_s_;
  std::shared_ptr<std::vector<render::Scene>> scenes_ =
      std::make_shared<std::vector<render::Scene>>();
};

/// How a run is filmed.
struct Look {
  render::PhotoStyle style = {};
  render::LabStand stand = {};
  render::PictureSize size = {};
  render::Shutter shutter = {};
  double roll_rad = 0;
};

Look look_of(Chance& chance, double frames_per_s, const render::PictureSize& size, unsigned seed) {
  Look look{.size = size};
  render::PhotoStyle& style = look.style;
  // Dark and coloured grains against a light backdrop, or light ones against a dark one.
  const bool is_dark = !chance.one_of(3);
  const auto colour = [&](double least, double most) {
    return render::Colour{chance.between(least, most), chance.between(least, most),
                          chance.between(least, most)};
  };
  style.grain = style.spot = is_dark ? colour(.12, .5) : colour(.75, .95);
  const double grey = is_dark ? chance.between(.7, .9) : chance.between(.1, .3);
  style.backdrop = {grey, grey, grey};
  const double plate = chance.between(.4, .75);
  style.plate = {plate, plate, plate};
  style.pattern = chance.one_of(2) ? chance.between(0, 1) : 0;
  style.gloss = chance.between(0, .6);
  style.key_fraction = chance.between(.4, .75);
  style.noise = chance.between(.004, .03);
  style.passes = 6;
  style.seed = seed;
  look.stand = {.distance_m = chance.between(2, 4), .height_m = chance.between(.002, .05)};
  look.shutter = {.frames_per_s = frames_per_s,
                  .exposure_s = std::min(chance.between(.05, .8) / frames_per_s, .02),
                  .hold_s = .4};
  look.roll_rad = chance.between(-.015, .015);
  return look;
}

/// A film of a run in a folder that is removed with it.
struct FilmedFile {
  testing::TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "film.mp4";
  vision::ScaleBar ruler;  ///< in the picture
};

std::unique_ptr<FilmedFile> filmed(const Recorder& recorder, const Look& look) {
  auto made = std::make_unique<FilmedFile>();
  render::FilmedRun run(recorder.states(), look.shutter);
  render::PerspectiveCamera camera = camera_on(look.stand, run.first(), look.size);
  camera.roll_rad = look.roll_rad;
  render::Renderer renderer;
  vision::FilmWriter film(made->file, look.shutter.frames_per_s);
  for (int frame = 0; frame < run.frames(); ++frame) {
    render::PhotoStyle style = look.style;
    style.frame = static_cast<std::uint64_t>(frame);
    film.add(renderer.expose(run.moments(frame, style.passes), camera, look.size, style));
  }
  film.close();
  const render::FilmTruth truth = film_truth_of(run, camera, look.size);
  made->ruler = {.line = truth.scale, .length_mm = truth.scale_mm};
  return made;
}

/// Restitutions of a ball's bounces, from its energy in flight: exact at any sampling time.
std::vector<double> restitutions_of(const std::vector<render::Scene>& scenes, double radius_m) {
  constexpr double kAbove_m = 1e-4, kChange = .01;
  std::vector<double> energies;
  for (const render::Scene& scene : scenes) {
    const render::PlacedGrain& ball = scene.grains.front();
    const double height = ball.pose.position.z() - radius_m;
    if (height < kAbove_m) continue;
    const double energy =
        .5 * ball.velocity.z() * ball.velocity.z() + kStandardGravity_m_s2 * height;
    if (energies.empty() || energy < (1 - kChange) * energies.back()) energies.push_back(energy);
  }
  std::vector<double> restitutions;
  for (std::size_t k = 1; k < energies.size(); ++k) {
    restitutions.push_back(std::sqrt(energies[k] / energies[k - 1]));
  }
  return restitutions;
}

FilmRow drop_row(double frames_per_s, unsigned seed) {
  Chance chance(seed);
  const dem::Model model = model_of(chance, false);
  const dem::DropProtocol protocol{.height_m = chance.between(.15, .25), .grains = 1};
  FilmRow row{.seed = seed,
              .setting = fmt::format("restitution {:.3f}", model.grain_wall.restitution)};
  Recorder recorder;
  run_drop(model, protocol, seed, {}, recorder.record(5e-4));
  const auto film =
      filmed(recorder, look_of(chance, frames_per_s, {.width = 480, .height = 360}, seed));
  const vision::DropTrack track = vision::track_drop(film->file);
  const std::vector<double> truths =
      restitutions_of(recorder.scenes(), model.grain.spheres.front().radius);
  row.reason = track.reason;
  row.is_flagged = track.status == vision::MeasureStatus::flagged;
  for (std::size_t k = 0; k < std::min(track.bounces.size(), truths.size()); ++k) {
    row.readings.push_back({truths[k], track.bounces[k].restitution});
  }
  return row;
}

FilmRow roll_row(double frames_per_s, bool has_scale, unsigned seed) {
  Chance chance(seed);
  const bool is_clump = chance.one_of(3);
  dem::Model model = model_of(chance, is_clump);
  const dem::RollProtocol protocol{.incline_deg = chance.between(10, 25),
                                   .release_m = chance.between(.08, .12)};
  // Chosen so that by its energy a ball rolls this far.
  const double far_m = chance.between(.1, .25);
  const double angle = protocol.incline_deg * std::numbers::pi / 180;
  model.grain_wall.rolling_friction =
      protocol.release_m * std::sin(angle) / (far_m + protocol.release_m * std::cos(angle));
  FilmRow row{.seed = seed,
              .setting = fmt::format("{} of {:.1f} mm on {:.1f} deg", is_clump ? "clump" : "ball",
                                     2e3 * model.grain.reach_m(), protocol.incline_deg)};
  Recorder recorder;
  const dem::Repeat repeat = run_roll(model, protocol, seed, {}, recorder.record(2e-3));
  if (repeat.readings.at("stopped_on_incline") != 0) {
    row.reason = "it stays on the incline";
    return row;
  }
  const auto film =
      filmed(recorder, look_of(chance, frames_per_s, {.width = 640, .height = 300}, seed));
  vision::TrackOptions options;
  vision::ScaleBar ruler = film->ruler;
  for (vision::Point* end : {&ruler.line.from, &ruler.line.to}) {
    end->x += chance.pointing_px();
    end->y += chance.pointing_px();
  }
  if (has_scale) {
    options.scale = ruler;
  } else {
    options.released_mm = 1e3 * protocol.release_m;
  }
  const vision::RollTrack track = track_roll(film->file, options);
  row.reason = track.reason;
  row.is_flagged = track.status == vision::MeasureStatus::flagged;
  if (track.has_reading) row.readings.push_back({repeat.value.value(), track.stopped_mm});
  return row;
}

FilmRow tilt_row(double frames_per_s, unsigned seed) {
  Chance chance(seed);
  const bool is_clump = chance.one_of(3);
  const dem::Model model = model_of(chance, is_clump);
  const dem::TiltProtocol protocol{.bonded = 2 + (chance.one_of(2) ? 1 : 0),
                                   .rate_deg_s = chance.between(2, 5)};
  FilmRow row{.seed = seed,
              .setting = fmt::format("{} {} at {:.1f} deg/s", protocol.bonded,
                                     is_clump ? "clumps" : "balls", protocol.rate_deg_s)};
  Recorder recorder;
  dem::Repeat repeat;
  try {
    repeat = run_tilt(model, protocol, seed, {}, recorder.record(.01));
  } catch (const dem::NoMeasurement& nothing) {
    row.reason = nothing.what();
    return row;
  }
  const auto film =
      filmed(recorder, look_of(chance, frames_per_s, {.width = 480, .height = 320}, seed));
  const vision::TiltTrack track = vision::track_tilt(film->file);
  row.reason = track.reason;
  row.is_flagged = track.status == vision::MeasureStatus::flagged;
  if (track.has_reading) row.readings.push_back({repeat.value.value(), track.angle_deg});
  return row;
}

void print_film(const FilmRow& row) {
  std::string line = fmt::format("  seed {}, {}:", row.seed, row.setting);
  for (const Reading& reading : row.readings) {
    line += fmt::format(" {:.4g} read {:.4g} +- {:.2g}{}", reading.truth, reading.read.value,
                        reading.read.uncertainty, row.is_flagged ? " (flagged)" : "");
  }
  if (row.readings.empty()) line += " refused: " + row.reason;
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

/// Errors of each film's first reading; intervals of all readings.
void print(const std::string& what, const char* unit, bool is_relative,
           const std::vector<FilmRow>& rows) {
  std::vector<double> errors;
  int held = 0, all = 0, flagged = 0;
  for (const FilmRow& row : rows) {
    flagged += row.is_flagged ? 1 : 0;
    for (const Reading& reading : row.readings) {
      const double off = std::abs(reading.read.value - reading.truth);
      if (&reading == &row.readings.front()) {
        errors.push_back(is_relative ? 100 * off / reading.truth : off);
      }
      ++all;
      held += off <= reading.read.uncertainty ? 1 : 0;
    }
  }
  if (errors.empty()) return;
  std::sort(errors.begin(), errors.end());
  fmt::print(
      "{}: {} films, {} refused, {} flagged; error: median {:.4f}, 95 % {:.4f}, worst {:.4f}{}; "
      "intervals hold {} of {}\n",
      what, rows.size(), rows.size() - errors.size(), flagged, errors[errors.size() / 2],
      errors[std::min(errors.size() - 1, errors.size() * 95 / 100)], errors.back(), unit, held,
      all);
  std::fflush(stdout);
}

template <typename Make>
std::vector<FilmRow> rows_of(int films, unsigned first_seed, bool prints_each, const Make& make) {
  std::vector<FilmRow> rows(static_cast<std::size_t>(films));
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t k) {
    rows[k] = make(first_seed + static_cast<unsigned>(k));
    if (prints_each || rows[k].readings.empty()) print_film(rows[k]);
  });
  return rows;
}

}  // namespace

void print_rendered_accuracy(const std::string& experiment, double frames_per_s, int films,
                             unsigned first_seed, bool prints_each) {
  const std::string rate = fmt::format("{:3.0f} frames/s", frames_per_s);
  if (experiment == "drop") {
    print(rate + ", rendered drops, restitution", "", false,
          rows_of(films, first_seed, prints_each,
                  [&](unsigned seed) { return drop_row(frames_per_s, seed); }));
  } else if (experiment == "tilt") {
    print(rate + ", rendered tilts, angle", " degrees", false,
          rows_of(films, first_seed, prints_each,
                  [&](unsigned seed) { return tilt_row(frames_per_s, seed); }));
  } else {
    for (const bool has_scale : {true, false}) {
      print(rate + ", rendered rolls, distance " + (has_scale ? "by a ruler" : "by the release"),
            " %", true, rows_of(films, first_seed, prints_each, [&](unsigned seed) {
              return roll_row(frames_per_s, has_scale, seed);
            }));
    }
  }
}

}  // namespace repose::bench
