#include "tests/calibrate/fake_simulator.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/units.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/propose.h"
#include "calibrate/fit/rounds.h"

namespace repose::calibrate::fake {
namespace {

constexpr int kReadings = 10;

/// Hashes (FNV-1a) everything that defines a job, so that no two jobs share their random numbers.
std::uint64_t mixed(const Job& job) {
  std::uint64_t mix = 0xcbf29ce484222325ULL;
  const auto add = [&](std::uint64_t word) { mix = (mix ^ word) * 0x100000001b3ULL; };
  add(job.seed);
  for (const char letter : job.experiment) add(static_cast<unsigned char>(letter));
  for (const double value : job.values) {
    add(std::bit_cast<std::uint64_t>(value));
    add(mix >> 29);
  }
  return mix;
}

double log_normal(Random& random, double sd) {
  return std::exp(sd * random.normal() - sd * sd / 2);
}

/// One reading with scatter: that of the laboratory if `bench`, else that of the simulation.
double scattered(const std::string& experiment, const std::string& reading, double mean, bool bench,
                 Random& random) {
  if (experiment == "drop") return mean * log_normal(random, bench ? .3 : .2);
  if (experiment == "roll") return (mean + 20) * log_normal(random, .39) - 20;
  if (experiment == "tilt") return bench ? mean + .8 * random.normal() : mean;
  return mean + (reading == "value" ? .7 : 1.5) * random.normal();
}

/// Effect of larger grains, including their additional scatter.
double size_effect(const Job& job, Random& random) {
  const double size = job.inputs.size;
  if (size == 1) return 0;
  return size_shift(job.values[4]) * std::log2(size) + .7 * (size - 1) * random.normal();
}

double heap(const std::string& reading, const std::vector<double>& v) {
  const double sliding = 1 - std::exp(-v[4] / .25);
  const double rolling = 1 - std::exp(-v[5] / .06);
  const double wall = 1 - std::exp(-v[1] / .2);
  if (reading == "value") return 8 + 24 * sliding * (.35 + .65 * rolling) + 2 * wall;
  return 150 - 45 * sliding - 8 * rolling - 12 * wall;
}

}  // namespace

std::vector<Parameter> parameters() {
  return {{"contact.particle_wall.restitution", .01, .6, {}},
          {"contact.particle_wall.sliding_friction", .1, .8, {}},
          {"contact.particle_wall.rolling_friction", .01, .17, {}},
          {"contact.particle_particle.restitution", .01, .6, {}},
          {"contact.particle_particle.sliding_friction", .05, .8, {}},
          {"contact.particle_particle.rolling_friction", .005, .2, {}}};
}

std::vector<Experiment> experiments() {
  return {{"drop", {0, 1, 2}, .6, true, {"value", "lowest_point_rise_mm"}},
          {"tilt", {0, 1, 2}, .5, false, {"value"}},
          {"roll", {0, 1, 2}, 1, true, {"value"}},
          {"heap", {0, 1, 2, 3, 4, 5}, 25, true, {"value", "base_radius_mm"}}};
}

double size_shift(double sliding_friction) {
  const double off = (sliding_friction - .45) / .35;
  return (off < 0 ? -5.5 : -3.5) * off * off;
}

double expected(const std::string& experiment, const std::string& reading,
                const std::vector<double>& v) {
  if (experiment == "drop") {
    const double fraction = std::max(0., .6 * v[0] - .03 - .05 * v[1]);
    return 500 * fraction * fraction * (reading == "value" ? 1 : .8);
  }
  if (experiment == "tilt") return std::atan(v[1]) / kDegree;
  if (experiment == "roll") return 345 * std::pow(.04 / v[2], 1.3) * (1 + .2 * (v[0] - .3)) - 20;
  return heap(reading, v);
}

Run run(const Job& job, bool jams) {
  if (jams && job.experiment == "heap" && job.values[4] > .55 && job.values[5] > .12) {
    return {job, {}, "the grains stay in the tube"};
  }
  Random random(mixed(job));
  Run run{job, {}, {}};
  for (const Experiment& experiment : experiments()) {
    if (experiment.name != job.experiment) continue;
    for (const std::string& reading : experiment.measurable) {
      double mean = expected(job.experiment, reading, job.values);
      if (experiment.name == "heap" && reading == "value") {
        mean -= kSofteningShift * std::log10(job.inputs.stiffness);
        mean += size_effect(job, random);
      }
      if (experiment.name == "drop") {
        mean *= std::pow(kFinerRebound, std::log(job.inputs.spheres) / std::log(4));
      }
      run.readings[reading] = scattered(job.experiment, reading, mean, false, random);
    }
  }
  return run;
}

Runs run_all(const std::vector<Job>& jobs, bool jams) {
  Runs runs;
  for (const Job& job : jobs) runs.push_back(run(job, jams));
  return runs;
}

std::vector<Observable> measured(const std::vector<double>& truth, std::uint64_t seed) {
  Random random(seed);
  std::vector<Observable> all;
  for (const Experiment& experiment : experiments()) {
    const std::string unit = experiment.name == "drop" || experiment.name == "roll" ? "mm" : "deg";
    const double mean = expected(experiment.name, "value", truth);
    std::vector<double> readings;
    for (int i = 0; i < kReadings; ++i) {
      readings.push_back(scattered(experiment.name, "value", mean, true, random));
    }
    double sum = 0;
    for (const double reading : readings) sum += reading;
    const double middle = sum / kReadings;
    double squares = 0;
    for (const double reading : readings) squares += (reading - middle) * (reading - middle);
    all.push_back({experiment.name,
                   experiment.name,
                   "value",
                   unit,
                   middle,
                   std::sqrt(squares / (kReadings - 1)),
                   kReadings,
                   {}});
  }
  return all;
}

Problem problem(const std::vector<double>& truth, std::uint64_t seed) {
  Problem problem{parameters(), measured(truth, seed), experiments(), {}};
  problem.settings.budget_s = 1200;
  problem.settings.seed = seed;
  return problem;
}

Experiment& experiment_of(Problem& problem, const std::string& name) {
  return *std::ranges::find(problem.experiments, name, &Experiment::name);
}

void coarsen(Problem& problem, double size) {
  experiment_of(problem, "heap").coarse = AssumedInputs{.size = size};
}

Runs first_runs(const Problem& problem, bool jams) {
  Runs runs = run_all(leading_jobs(problem), jams);
  const Runs following = run_all(following_jobs(problem, runs), jams);
  runs.insert(runs.end(), following.begin(), following.end());
  return runs;
}

Runs study(const Problem& problem, bool jams) {
  Runs runs;
  for (std::vector<Job> jobs = propose(problem, runs); !jobs.empty();
       jobs = propose(problem, runs)) {
    for (Run& run : run_all(jobs, jams)) runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace repose::calibrate::fake
