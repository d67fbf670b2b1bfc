#include "tests/peers/exported.h"

#include <algorithm>
#include <stdexcept>

#include "calibrate/simulators/liggghts_readings.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"

namespace repose::testing {
namespace {

using calibrate::ExportTarget;

/// The program and the file names of its decks: "drop" + ending.
struct Program {
  std::string name;
  std::string ending;
};

Program program_of(ExportTarget target) {
  if (target == calibrate::liggghts_target()) return {"liggghts", ".lig"};
  if (target == calibrate::lammps_target()) return {"lmp", ".lmp"};
  if (target == calibrate::yade_target()) return {"yade", ".py"};
  throw std::invalid_argument("there is no program to run this export");
}

/// The end of a program's output.
std::string last_of(const std::string& text) {
  constexpr std::size_t kShown = 600;
  return text.substr(text.size() - std::min(text.size(), kShown));
}

/// The number after the last "reading: NAME ".
double reading_in(const std::string& out, const std::string& name) {
  const std::string key = "\nreading: " + name + ' ';
  const std::size_t place = out.rfind(key);
  if (place == std::string::npos) throw std::runtime_error("no " + name + ": " + last_of(out));
  return std::stod(out.substr(place + key.size()));
}

double mean_rise_mm(const TemporaryFolder& folder, const std::string& deck, int grains) {
  double sum_m = 0;
  for (int k = 1; k <= grains; ++k) {
    const std::string file = deck + "_" + std::to_string(k) + ".txt";
    const auto bounce = calibrate::bounce_in(folder.path() / file);
    if (!bounce) throw std::runtime_error(file + ": the grain never rose");
    sum_m += bounce->rise_m;
  }
  return 1e3 * sum_m / grains;
}

/// Writes the export to the folder.
void write_decks(const TemporaryFolder& folder, const dem::Study& study,
                 const dem::ClumpShape& grain, ExportTarget target) {
  calibrate::write_export(
      folder.path(),
      calibrate::export_study(study, grain, {}, {.target = target, .takes_approximate = true})
          .files);
}

}  // namespace

Finished run_deck(const TemporaryFolder& folder, ExportTarget target, const std::string& deck,
                  const std::vector<std::string>& arguments) {
  const Program program = program_of(target);
  const std::string file = deck + program.ending;
  std::vector<std::string> words = {"-in", file, "-log", "none"};
  if (target == calibrate::yade_target()) words = {"-n", "-x", "-j", "1", file};
  words.insert(words.end(), arguments.begin(), arguments.end());
  Finished done = run_program(program.name, folder, words);
  if (done.exit_code != 0) {
    throw std::runtime_error(file + " failed: " + last_of(done.out) + last_of(done.err));
  }
  return done;
}

dem::Study short_study(dem::RollingModel rolling, double restitution) {
  dem::Study study;
  study.model.grain_material = {"ball", 1000, 1e7, .3};
  study.model.wall_material = {"wall", 1000, 1e9, .25};
  study.model.grain_wall = {restitution, .4, .1};
  study.model.rolling = rolling;
  study.experiments[dem::experiment_of<dem::DropProtocol>()].protocol =
      dem::DropProtocol{.height_m = .05, .grains = 3};
  study.experiments[dem::experiment_of<dem::TiltProtocol>()].protocol =
      dem::TiltProtocol{.bonded = 2, .rate_deg_s = 10};
  study.experiments[dem::experiment_of<dem::RollProtocol>()].protocol =
      dem::RollProtocol{.incline_deg = 10, .release_m = .08};
  return study;
}

Readings our_readings(const dem::Study& study, const dem::ClumpShape& grain) {
  dem::Model model = study.model;
  model.grain = grain;
  model.grain_grain = model.grain_wall;  // has no effect
  return {
      .drop_mm = run_drop(model, study.protocol<dem::DropProtocol>(), study.seed).value.value(),
      .tilt_deg = run_tilt(model, study.protocol<dem::TiltProtocol>(), study.seed)
                      .readings.at("half_mm_slip_deg"),
      .roll_mm = run_roll(model, study.protocol<dem::RollProtocol>(), study.seed).value.value()};
}

Readings readings_of(const dem::Study& study, const dem::ClumpShape& grain, ExportTarget target) {
  const TemporaryFolder folder;
  write_decks(folder, study, grain, target);
  Readings readings;
  const std::string dropped = run_deck(folder, target, "drop").out;
  readings.drop_mm = target == calibrate::yade_target()
                         ? reading_in(dropped, "drop_mm")
                         : mean_rise_mm(folder, "drop", study.protocol<dem::DropProtocol>().grains);
  readings.tilt_deg = reading_in(run_deck(folder, target, "tilt").out, "half_mm_slip_deg");
  readings.roll_mm = reading_in(run_deck(folder, target, "roll").out, "roll_mm");
  return readings;
}

double reading_of(const dem::Study& study, const dem::ClumpShape& grain, ExportTarget target,
                  const std::string& deck, const std::string& name,
                  const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  write_decks(folder, study, grain, target);
  return reading_in(run_deck(folder, target, deck, arguments).out, name);
}

double rebound_mm_of(const dem::Study& study, const dem::ClumpShape& grain, ExportTarget target,
                     const std::string& deck, int grains) {
  const TemporaryFolder folder;
  write_decks(folder, study, grain, target);
  run_deck(folder, target, deck);
  return mean_rise_mm(folder, deck, grains);
}

bool has_program_for(ExportTarget target) {
  const std::string name = program_of(target).name;
  if (target == calibrate::yade_target())
    return run_program(name, {}, {"--version"}).exit_code == 0;
  // LIGGGHTS has no option that only prints its version; an empty deck ends at once.
  return run_program(name, {}, {"-in", "/dev/null", "-log", "none"}).exit_code == 0;
}

}  // namespace repose::testing
