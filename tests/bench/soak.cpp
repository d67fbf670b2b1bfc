#include <cmath>
#include <exception>
#include <map>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "base/input_error.h"
#include "base/random.h"
#include "dem/contact/model_names.h"
#include "dem/engine/unstable_run.h"
#include "dem/experiment/draw_down.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/pendulum.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "dem/experiment/tilt_on_grains.h"
#include "dem/shape/clump/fill.h"
#include "dem/shape/scan/calliper.h"
#include "tests/bench/benches.h"
#include "tests/bench/clock.h"

// Experiments of a few grains with random settings that a study may have. Each must end with finite
// readings, or with a reason why there are none. Any that does not is printed with its number,
// which reproduces it: --first N --count 1.

namespace repose::bench {
namespace {

struct Soak {
  std::uint64_t seed = 1;
  int first = 0;
  int count = 100;
  double longest_s = 20;  ///< of one run
  std::string only;       ///< this experiment; empty: all
};

/// Uniform in the logarithm.
double spread(base::Random& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

int whole(base::Random& random, int low, int high) {
  return low + static_cast<int>(random.uniform() * (high - low + 1));
}

dem::ClumpShape grain(base::Random& random) {
  const double length_m = spread(random, 1e-3, 3e-2);
  const double width_m = length_m * random.between(.6, 1);
  const dem::CalliperSizes sizes{.length_m = length_m,
                                 .width_m = width_m,
                                 .thickness_m = width_m * random.between(.6, 1),
                                 .tip_fraction = random.between(0, .6)};
  return dem::clump_of(dem::calliper_surface(sizes), {.spheres = whole(random, 1, 5)}).shape;
}

dem::PairCoefficients pair(base::Random& random) {
  return {.restitution = random.between(.05, .95),
          .sliding_friction = random.between(.05, 1.2),
          .rolling_friction = random.between(0, .3)};
}

/// Soft enough for a run to take about a second, stiff enough not to be squashed.
dem::Model model(base::Random& random) {
  dem::Model model;
  model.grain = grain(random);
  const double density = spread(random, 300, 5000);
  model.grain_material = {.name = "grain",
                          .density_kg_m3 = density,
                          .young_modulus_pa = spread(random, 1e6, 1e8),
                          .poisson_ratio = random.between(.1, .45)};
  model.wall_material = {.name = "wall",
                         .density_kg_m3 = 7800,
                         .young_modulus_pa = spread(random, 1e7, 1e11),
                         .poisson_ratio = random.between(.1, .45)};
  model.grain_wall = pair(random);
  model.grain_grain = pair(random);
  model.rolling = dem::kRollingNames.at(static_cast<std::size_t>(whole(random, 0, 3))).first;
  return model;
}

dem::HeapProtocol heap(double reach_m, base::Random& random) {
  return {.tube_diameter_m = reach_m * random.between(8, 12),
          .tube_height_m = reach_m * random.between(20, 40),
          .lift_speed_m_s = spread(random, .05, .5),
          .plate_m = reach_m * random.between(40, 60),
          .grains = whole(random, 5, 30),
          .allow_partial_fill = true};
}

dem::DrawDownProtocol draw_down(double reach_m, base::Random& random) {
  dem::DrawDownProtocol boxes{.length_m = 0,
                              .depth_m = reach_m * random.between(8, 10),
                              .slot_m = reach_m * random.between(10, 14),
                              .fill_m = reach_m * random.between(8, 10),
                              .drop_m = 0};
  boxes.length_m = boxes.slot_m + reach_m * random.between(16, 24);
  boxes.drop_m = boxes.fill_m + boxes.slot_m * random.between(.5, 1);
  return boxes;
}

dem::Protocol protocol(dem::Experiment experiment, const dem::Model& model, base::Random& random) {
  constexpr double kSparse = .65, kDense = .85;
  const double reach_m = model.grain.reach_m();
  if (experiment == dem::experiment_of<dem::DropProtocol>()) {
    return dem::DropProtocol{.height_m = spread(random, .01, .5), .grains = whole(random, 1, 2)};
  }
  if (experiment == dem::experiment_of<dem::TiltProtocol>()) {
    return dem::TiltProtocol{.bonded = whole(random, 2, 4), .rate_deg_s = spread(random, 4, 10)};
  }
  if (experiment == dem::experiment_of<dem::RollProtocol>()) {
    return dem::RollProtocol{.incline_deg = random.between(5, 45),
                             .release_m = reach_m * random.between(3, 10),
                             .release_turn_deg = random.between(0, 90)};
  }
  if (experiment == dem::experiment_of<dem::GrainDropProtocol>()) {
    return dem::GrainDropProtocol{.height_m = spread(random, .01, .5),
                                  .grains = whole(random, 1, 3),
                                  .coverage = random.between(kSparse, kDense)};
  }
  if (experiment == dem::experiment_of<dem::GrainTiltProtocol>()) {
    return dem::GrainTiltProtocol{.bonded = whole(random, 1, 4),
                                  .rate_deg_s = spread(random, 4, 10),
                                  .places = whole(random, 1, 2),
                                  .coverage = random.between(kSparse, kDense)};
  }
  if (experiment == dem::experiment_of<dem::GrainRollProtocol>()) {
    return dem::GrainRollProtocol{.rate_deg_s = spread(random, 4, 10),
                                  .places = whole(random, 1, 2),
                                  .coverage = random.between(kSparse, kDense)};
  }
  if (experiment == dem::experiment_of<dem::FillProtocol>()) {
    return dem::FillProtocol{.tube_diameter_m = reach_m * random.between(8, 12),
                             .tube_height_m = reach_m * random.between(8, 12),
                             .pour_m = spread(random, .005, .1)};
  }
  if (experiment == dem::experiment_of<dem::PendulumProtocol>()) {
    return dem::PendulumProtocol{.string_m = spread(random, .05, 2),
                                 .release_deg = random.between(5, 90),
                                 .pairs = whole(random, 1, 3)};
  }
  if (experiment == dem::experiment_of<dem::DrawDownProtocol>()) {
    return draw_down(reach_m, random);
  }
  if (experiment == dem::experiment_of<dem::HeapProtocol>()) return heap(reach_m, random);
  return experiment->usual;
}

bool is_finite(const dem::Repeat& repeat) {
  bool is_good = repeat.timestep_s > 0 && std::isfinite(repeat.clump_steps) &&
                 (repeat.value ? std::isfinite(*repeat.value) : !repeat.envelopes.empty());
  for (const auto& [name, value] : repeat.readings) {
    is_good = is_good && std::isfinite(value.value_or(0));
  }
  return is_good;
}

/// How a run ended, in a word or two.
std::string ending(dem::Experiment experiment, std::uint64_t number, const Soak& soak,
                   std::string& why) {
  base::Random random(soak.seed * 1'000'003 + number);
  const Clock::time_point start = Clock::now();
  const auto report = [&](double, const dem::Simulation&) {
    return seconds_since(start) < soak.longest_s;
  };
  try {
    const dem::Model simulated = model(random);
    const dem::Protocol done = protocol(experiment, simulated, random);
    const dem::Repeat repeat = experiment->run(simulated, done, number + 1, report, {});
    return is_finite(repeat) ? "readings" : "NOT FINITE";
  } catch (const dem::NoMeasurement&) {
    return "no reading";
  } catch (const dem::UnstableRun& error) {
    why = error.what();
    return "UNSTABLE";
  } catch (const dem::Interrupted&) {
    return "too long";
  } catch (const base::InputError& error) {
    why = error.what();
    return "refused";
  } catch (const std::exception& error) {
    why = error.what();
    return "FAILED";
  }
}

void soak_all(dem::Experiment experiment, const Soak& soak) {
  std::map<std::string, int> endings;
  for (int k = soak.first; k < soak.first + soak.count; ++k) {
    std::string why;
    const std::string how = ending(experiment, static_cast<std::uint64_t>(k), soak, why);
    ++endings[how];
    if (how != "readings" && how != "no reading") {
      fmt::print("{} {}: {} {}\n", dem::name_of(experiment), k, how, why);
    }
  }
  fmt::print("{}:", dem::name_of(experiment));
  for (const auto& [how, count] : endings) fmt::print(" {} {};", count, how);
  fmt::print(" of {}\n", soak.count);
}

}  // namespace

void add_soak(CLI::App& bench) {
  CLI::App& app = *bench.add_subcommand("soak", "Many experiments with random settings");
  const auto soak = std::make_shared<Soak>();
  app.add_option("--only", soak->only, dem::experiment_names());
  app.add_option("--count", soak->count, "of each experiment (100)");
  app.add_option("--first", soak->first, "number of the first (0)");
  app.add_option("--seed", soak->seed, "another seed, other settings (1)");
  app.add_option("--longest-s", soak->longest_s, "of one run (20)");
  app.callback([soak] {
    for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
      if (soak->only.empty() || entry.name == soak->only) soak_all(&entry, *soak);
    }
  });
}

}  // namespace repose::bench
