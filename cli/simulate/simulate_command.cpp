#include "cli/simulate/simulate_command.h"

#include <memory>
#include <string>
#include <vector>

#include "cli/simulate/simulate.h"
#include "dem/study/experiment_table.h"

namespace repose::cli {
namespace {

constexpr const char* kSimulateNotes = R"(
EXPERIMENT is drop (rebound height, mm), tilt (angle of sliding, degrees),
roll (distance along the flat, mm), heap (angle of repose, degrees) or, to
tell grains apart, drop_on_grains (mm), tilt_on_grains, roll_on_grains
(degrees), fill (bulk density, kg/m3), pendulum (swing, degrees), draw_down
(discharged mass, %). STUDY is a study file: samples/hazelnut/study.toml
explains many of its keys.

A heap's final state is rendered as silhouettes from --views directions,
equally spaced over half a turn, each measured as repose measure does: 1 is the
XZ view alone, 0 renders none. If at least half of the views of a repeat could
be measured, its value is their mean, otherwise the angle from the grains'
positions; both are reported.

Each repeat has its own seed: --seed and the following numbers. The same seed
gives the same result with any number of threads. With --out, the same command
resumes an interrupted run.

Examples:
  repose simulate drop study.toml --repeats 10
  repose simulate heap study.toml --set contact.particle_wall.restitution=0.3
)";

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) names.emplace_back(entry.name);
  return names;
}

}  // namespace

Command simulate_command() {
  const auto given = std::make_shared<SimulateArguments>();
  return {
      .name = "simulate",
      .summary = "Simulate an experiment of a study",
      .options = {{.name = "experiment",
                   .value_name = "EXPERIMENT",
                   .help = "Experiment",
                   .target = &given->experiment,
                   .is_required = true,
                   .words = experiment_names()},
                  {"study", "STUDY.toml", "Study file", &given->study, true},
                  {"--set", "KEY=VALUE", "Replace a value of the study; repeatable",
                   &given->settings},
                  {"--seed", "N", "Seed of the first repeat", &given->seed},
                  {"--repeats", "N", "Number of repeats, each with its own seed", &given->repeats},
                  {"--threads", "N", "Threads (all cores)", &given->threads},
                  {"--out", "FOLDER", "Output folder; makes the run resumable", &given->out_folder},
                  {"--trajectory-s", "DT", "Save a frame every DT s of simulated time",
                   &given->trajectory_s},
                  {"--views", "N", "Views of each heap to measure (9)", &given->views},
                  {"--json", "FILE|-", "Full results, for programs", &given->json_file}},
      .notes = kSimulateNotes,
      .missing = "an experiment and a study file are needed. Fix: repose simulate heap STUDY.toml.",
      .run = [given] { return run_simulate(*given); }};
}

}  // namespace repose::cli
