#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/export/conversions.h"
#include "calibrate/export/facts.h"
#include "calibrate/export/target_entry.h"
#include "calibrate/simulators/liggghts_readings.h"
#include "calibrate/simulators/program_simulator.h"
#include "calibrate/simulators/simulators.h"
#include "dem/contact/model_names.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/pendulum.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "dem/experiment/tilt_on_grains.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "liggghts";
/// Which decks made a run, and how they are read. To be raised whenever that changes what a run
/// gives.
constexpr int kDecks = 1;

/// LIGGGHTS takes primes above 10000 for seeds, and none that grain.lig has. Any two that follow
/// each other up to 2^30 are less than 512 apart, so that seeds below 2^21 have one each.
std::uint64_t prime_of(std::uint64_t seed) {
  constexpr std::uint64_t kApart = 512, kLeast = 20'000;
  constexpr int kBits = 21;
  const std::uint64_t folded =
      (seed ^ (seed >> kBits) ^ (seed >> (2 * kBits))) & ((std::uint64_t{1} << kBits) - 1);
  std::uint64_t number = kLeast + kApart * folded;
  const auto is_prime = [](std::uint64_t one) {
    for (std::uint64_t divisor = 2; divisor * divisor <= one; ++divisor) {
      if (one % divisor == 0) return false;
    }
    return true;
  };
  const auto is_of_decks = [](std::uint64_t one) { return one == 67867967 || one == 49979687; };
  while (!is_prime(number) || is_of_decks(number)) ++number;
  return number;
}

/// The run as an export sees it: a study of this experiment alone.
ExportFacts facts_of(const RunSpec& spec, std::uint64_t seed) {
  dem::Study study;
  study.file = "study.toml";
  study.seed = seed;
  const bool is_tilt = is_one_of<dem::TiltProtocol>(spec.protocol);
  study.model = is_tilt ? dem::quiet(spec.model) : spec.model;
  dem::StudyExperiment& described = study.experiments[&spec.entry()];
  described.protocol = spec.protocol;
  described.stiffness_factor = spec.model.stiffness_factor;
  ExportFacts facts(std::move(study), spec.model.grain, {}, liggghts_target());
  facts.take_longer_steps();
  return facts;
}

double number_in(const PrintedLines& printed, const char* name, const fs::path& folder) {
  const auto found = printed.readings.find(name);
  if (found != printed.readings.end()) return found->second;
  base::refuse(folder / ProgramSimulator::kOutputFile,
               fmt::format("LIGGGHTS ended without the line \"reading: {}\"", name),
               "look there for what it says.");
}

class LiggghtsSimulator : public ProgramSimulator {
 public:
  LiggghtsSimulator(const dem::EngineChoice& choice, std::string version)
      : ProgramSimulator(choice.timeout_s), choice_(choice), version_(std::move(version)) {}

  std::string title() const override {
    return choice_.processes == 1 ? version_
                                  : fmt::format("{}, {} processes", version_, choice_.processes);
  }

  std::string identity(const RunSpec& spec) const override {
    nlohmann::ordered_json json{{"program", kProgram}, {"version", version_}, {"decks", kDecks}};
    // Where sums and random numbers are taken in another order, grains go other ways.
    if (processes(spec.entry()) > 1) json["processes"] = processes(spec.entry());
    return json.dump();
  }

  int processes(const dem::ExperimentEntry& entry) const override {
    return entry.is_bulk ? choice_.processes : 1;
  }

  bool has_state(const dem::ExperimentEntry& entry) const override { return entry.is_pictured; }

  bool has_reading(const dem::ExperimentEntry& entry, const std::string& name) const override {
    if (entry.is_pictured) return true;
    static const std::set<std::string> kTheirs = {"above_first_touch_mm",
                                                  "sd_mm",
                                                  "never_rose",
                                                  "lateral_mm",
                                                  "stopped_on_incline",
                                                  "releases",
                                                  "time_s",
                                                  "grains",
                                                  "mass_g",
                                                  "solid_fraction",
                                                  "rise_mm",
                                                  "half_mm_slip_deg",
                                                  "begin_deg"};
    return kTheirs.contains(name);
  }

  std::vector<base::Fault> refusals(const RunSpec& spec) const override {
    base::Faults faults;
    find_unsupported(spec, faults);
    if (!faults.empty()) return faults.all();
    const ExportFacts facts = facts_of(spec, 1);
    const std::vector<Conversion> conversions = conversions_of(facts, liggghts_target());
    faults.add_all(calibrate::refusals(
        facts, {.target = liggghts_target(), .takes_approximate = true}, conversions));
    for (const Conversion& one : conversions) {
      if (one.fidelity != Fidelity::approximate || choice_.takes_approximate) continue;
      faults.add({.subject = one.coefficient,
                  .value = fmt::format("= {:.4g} ({}) has no exact counterpart in LIGGGHTS. {}",
                                       one.value, dem::name_of(spec.model.rolling), one.limits),
                  .fix = fmt::format("choose a value, or a rolling_model, that LIGGGHTS has "
                                     "(relative_constant_torque or elastic_plastic); or write "
                                     "approximate = true in [engine], which simulates {:.4g}.",
                                     one.exported)});
    }
    return faults.all();
  }

  std::vector<std::string> differences(const RunSpec& spec) const override;

 protected:
  void prepare(const RunSpec& spec, std::uint64_t seed, const fs::path& folder) const override {
    const ExportFacts facts = facts_of(spec, seed);
    const auto files = liggghts_target()->files(facts, conversions_of(facts, liggghts_target()));
    for (const ExportedFile& file : files) base::write_whole_file(folder / file.name, file.text);
  }

  base::ProcessStart start(const RunSpec& spec, std::uint64_t seed,
                           const fs::path& /*folder*/) const override {
    std::vector<std::string> words;
    if (processes(spec.entry()) > 1) {
      words = {choice_.launcher, "-n", std::to_string(processes(spec.entry()))};
      // Runs at once would all be bound to the same first cores.
      if (choice_.launcher == "mpirun") words.insert(words.end(), {"--bind-to", "none"});
    }
    // Line by line: what it printed last before it failed would be lost.
    words.insert(words.end(),
                 {"stdbuf", "-oL", kProgram, "-in", dem::name_of(&spec.entry()) + ".lig", "-log",
                  "none", "-var", "seed", std::to_string(prime_of(seed))});
    return {.words = std::move(words), .folder = {}, .output = {}};
  }

  dem::Repeat read_back(const RunSpec& spec, std::uint64_t seed,
                        const fs::path& folder) const override;

 private:
  static void find_unsupported(const RunSpec& spec, base::Faults& faults);

  dem::EngineChoice choice_;
  std::string version_;
};

void LiggghtsSimulator::find_unsupported(const RunSpec& spec, base::Faults& faults) {
  const std::string name = dem::name_of(&spec.entry());
  const std::string own = fmt::format(
      "simulate it with our own engine: program = \"{}\" in [engine].", dem::kOwnEngine);
  const bool is_done = liggghts_target()->has_deck(spec.protocol) && spec.entry().front == nullptr;
  faults.require(is_done, {.subject = "experiment." + name,
                           .value = "cannot be simulated with LIGGGHTS",
                           .rule = "drop, tilt, roll, heap, drop_on_grains, tilt_on_grains, "
                                   "roll_on_grains, pendulum, or fill without taps and pour_g_s",
                           .fix = own});
  if (is_one_of<dem::DropProtocol>(spec.protocol)) {
    faults.require(!spec.protocol.as<dem::DropProtocol>().low_height_m,
                   {.subject = "experiment.drop.low_height_mm",
                    .value = "has no counterpart in LIGGGHTS, whose decks drop from one height",
                    .fix = "leave it out, or " + own});
  }
  faults.require(spec.model.size_cv == 0,
                 {.subject = "particle.size_sd_percent",
                  .value = fmt::format("= {:g} has no counterpart in the decks of LIGGGHTS, whose "
                                       "grains are all alike",
                                       100 * spec.model.size_cv),
                  .fix = "0, or " + own});
  faults.require(!spec.model.timestep_s && spec.model.timestep_fraction == 1,
                 {.subject = "simulation.timestep",
                  .value = "would have no effect: LIGGGHTS has half of our longest accurate step",
                  .fix = "leave timestep_s and timestep_fraction out."});
}

std::vector<std::string> LiggghtsSimulator::differences(const RunSpec& spec) const {
  std::vector<std::string> all;
  std::set<std::string> told;
  const ExportFacts facts = facts_of(spec, 1);
  for (const Conversion& one : conversions_of(facts, liggghts_target())) {
    if (one.exported != one.value && one.value != 0) {
      all.push_back(fmt::format("{} is {:.4g} times ours there ({}).", one.coefficient,
                                one.exported / one.value, name_of(one.fidelity)));
    }
    if (one.limits.empty() || !told.insert(one.limits).second) continue;
    all.push_back(fmt::format("{}: {}", one.target_name, one.limits));
  }
  if (is_one_of<dem::HeapProtocol>(spec.protocol)) {
    all.emplace_back(
        "The tube, of 96 flat sides, is filled by grains that are placed above each other and fall "
        "all at once; ours rain in layers.");
  }
  if (is_one_of<dem::TiltProtocol>(spec.protocol)) {
    all.emplace_back("Gravity turns in steps of 2 ms in place of the plate.");
  }
  return all;
}

/// A mean of single grains, and what goes with it.
dem::Repeat drops_in(const fs::path& folder, const std::string& name, int grains) {
  double sum = 0, squares = 0, above = 0;
  int never_rose = 0;
  std::vector<double> rises;
  for (int k = 1; k <= grains; ++k) {
    const auto bounce = bounce_in(folder / fmt::format("{}_{}.txt", name, k));
    never_rose += bounce ? 0 : 1;
    rises.push_back(bounce ? kMmPerM * bounce->rise_m : 0);
    sum += rises.back();
    above += bounce ? kMmPerM * bounce->above_first_touch_m : 0;
  }
  const double mean = sum / grains;
  for (const double rise : rises) squares += (rise - mean) * (rise - mean);
  dem::Repeat repeat;
  repeat.value = mean;
  repeat.readings = {{"above_first_touch_mm", above / grains},
                     {"sd_mm", dem::scatter_of(squares, rises.size())},
                     {"never_rose", never_rose}};
  return repeat;
}

dem::Repeat tilt_in(const PrintedLines& printed, const ExportFacts& facts, const fs::path& folder) {
  const auto& protocol = facts.study().protocol<dem::TiltProtocol>();
  dem::Slide slide;
  for (const auto& [angle, slip] : printed.slips) slide.add(angle, slip, facts.grain());
  if (!printed.slips.empty() && printed.slips.back().second < dem::most_slip_m(facts.grain())) {
    throw dem::NoMeasurement(
        fmt::format("tilt: the body did not slide up to {:g} degrees", dem::kSteepest_deg));
  }
  dem::Repeat repeat;
  const double begin = facts.tilt_begin_deg();
  repeat.value = dem::onset_deg(slide, begin, protocol.rate_deg_s);
  repeat.readings = {{"half_mm_slip_deg", number_in(printed, "half_mm_slip_deg", folder)},
                     {"begin_deg", begin}};
  return repeat;
}

dem::Repeat roll_in(const PrintedLines& printed, const ExportFacts& facts, const fs::path& folder) {
  const double moved_m = number_in(printed, "still_moved_m", folder);
  const double reached_mm = number_in(printed, "roll_mm", folder);
  if (moved_m > 1e-3 * facts.grain().reach_m()) {
    throw dem::NoMeasurement(fmt::format(
        "roll: the grain still moves {:.2f} m from the foot, by {:.2g} mm in a tenth of "
        "a second. Fix: more rolling friction between particle and wall, which is {:g}.",
        reached_mm / kMmPerM, kMmPerM * moved_m, facts.study().model.grain_wall.rolling_friction));
  }
  dem::Repeat repeat;
  repeat.value = std::max(0., reached_mm);
  repeat.readings = {{"lateral_mm", number_in(printed, "lateral_mm", folder)},
                     {"stopped_on_incline", reached_mm > 0 ? 0 : 1},
                     {"releases", number_in(printed, "releases", folder)},
                     {"time_s", number_in(printed, "steps", folder) *
                                    facts.timestep_s(dem::experiment_of<dem::RollProtocol>())}};
  return repeat;
}

dem::Repeat heap_in(const PrintedLines& printed, const RunSpec& spec, std::uint64_t seed,
                    const ExportFacts& facts, const fs::path& folder) {
  const auto& protocol = spec.protocol.as<dem::HeapProtocol>();
  const auto spheres = static_cast<double>(facts.grain().spheres.size());
  const int inserted = static_cast<int>(number_in(printed, "inserted_spheres", folder) / spheres);
  const int filled = static_cast<int>(number_in(printed, "filled_spheres", folder) / spheres);
  if (!printed.remark.empty()) {
    throw dem::NoMeasurement("heap: grains hang in the tube. Fix: a wider tube, or less friction.");
  }
  if (filled < inserted) {
    throw dem::NoMeasurement(fmt::format(
        "heap: {} of {} grains were lost while the tube was filled: they went through its wall or "
        "over its rim. Fix: a stiffer grain (stiffness_factor), or fewer grains.",
        inserted - filled, inserted));
  }
  const bool are_balls = facts.is_sphere();
  dem::StandingHeap heap{
      .grains = grains_in(folder / (are_balls ? "heap.dump" : "heap_bodies.dump"), are_balls),
      .lifted = filled};
  std::erase_if(heap.grains, [](const dem::Grain& grain) { return grain.position.z() < 0; });
  if (static_cast<int>(heap.grains.size()) > filled) {
    base::refuse(folder / "heap.dump", "has more grains than were put in", "run it again.");
  }
  heap.is_at_rest = number_in(printed, "moved_m", folder) <= 1e-3 * facts.grain().reach_m();
  dem::Repeat repeat = dem::heap_from(spec.model, protocol, seed, heap);
  repeat.readings["time_s"] = number_in(printed, "steps", folder) *
                              facts.timestep_s(dem::experiment_of<dem::HeapProtocol>());
  return repeat;
}

dem::Repeat fill_in(const PrintedLines& printed, const ExportFacts& facts, const fs::path& folder) {
  if (!printed.remark.empty()) {
    throw dem::NoMeasurement("fill: the grains do not reach the tube's rim. Fix: a lower tube.");
  }
  const auto& protocol = facts.study().protocol<dem::FillProtocol>();
  const double radius = .5 * protocol.tube_diameter_m;
  const double tube_m3 = std::numbers::pi * radius * radius * protocol.tube_height_m;
  const double grains = number_in(printed, "grains", folder);
  dem::Repeat repeat;
  repeat.value = number_in(printed, "bulk_density_kg_m3", folder);
  repeat.readings = {{"grains", grains},
                     {"mass_g", 1e3 * grains * facts.mass_kg()},
                     {"solid_fraction", grains * facts.grain().volume_m3 / tube_m3}};
  return repeat;
}

/// Of bodies on glued grains, whose angle is the mean of their places.
dem::Repeat places_in(const PrintedLines& printed, const fs::path& folder) {
  dem::Repeat repeat;
  repeat.value = number_in(printed, "angle_deg", folder);
  double squares = 0;
  for (const double place : printed.places) squares += std::pow(place - *repeat.value, 2);
  repeat.readings = {{"sd_deg", dem::scatter_of(squares, printed.places.size())}};
  return repeat;
}

dem::Repeat LiggghtsSimulator::read_back(const RunSpec& spec, std::uint64_t seed,
                                         const fs::path& folder) const {
  const ExportFacts facts = facts_of(spec, seed);
  const PrintedLines printed = printed_lines(folder / kOutputFile);
  const dem::Protocol& protocol = spec.protocol;
  const std::string name = dem::name_of(&spec.entry());
  dem::Repeat repeat;
  if (is_one_of<dem::DropProtocol>(protocol)) {
    repeat = drops_in(folder, name, protocol.as<dem::DropProtocol>().grains);
  } else if (is_one_of<dem::GrainDropProtocol>(protocol)) {
    repeat = drops_in(folder, name, protocol.as<dem::GrainDropProtocol>().grains);
  } else if (is_one_of<dem::TiltProtocol>(protocol)) {
    repeat = tilt_in(printed, facts, folder);
  } else if (is_one_of<dem::RollProtocol>(protocol)) {
    repeat = roll_in(printed, facts, folder);
  } else if (is_one_of<dem::HeapProtocol>(protocol)) {
    repeat = heap_in(printed, spec, seed, facts, folder);
  } else if (is_one_of<dem::FillProtocol>(protocol)) {
    repeat = fill_in(printed, facts, folder);
  } else if (is_one_of<dem::PendulumProtocol>(protocol)) {
    repeat.value = number_in(printed, "swing_deg", folder);
    repeat.readings = {{"rise_mm", number_in(printed, "rise_mm", folder)}};
  } else {
    repeat = places_in(printed, folder);
  }
  repeat.timestep_s = facts.timestep_s(&spec.entry());
  repeat.steps = printed.steps;
  repeat.clump_steps =
      static_cast<double>(repeat.steps) * repeat.readings.number("grains").value_or(1);
  return repeat;
}

}  // namespace

std::shared_ptr<const Simulator> liggghts_simulator(const dem::EngineChoice& choice) {
  const auto printed = printed_by({kProgram, "-in", "/dev/null", "-log", "none"});
  const std::string key = "Version ";
  const std::size_t begin = printed ? printed->find(key) : std::string::npos;
  base::Faults faults;
  faults.require(begin != std::string::npos,
                 {.subject = "engine.program",
                  .value = "= \"liggghts\" is not installed, or does not start",
                  .rule = "the command liggghts starts LIGGGHTS-PUBLIC 3.8",
                  .fix = "apt-get install liggghts, or put its folder into PATH."});
  if (choice.processes > 1) {
    const bool is_there = printed_by({choice.launcher, "--version"}).has_value();
    faults.require(
        is_there,
        {.subject = "engine.launcher",
         .value = fmt::format("= \"{}\" is not installed, or does not start", choice.launcher),
         .rule = fmt::format("it starts the {} processes of a run", choice.processes),
         .fix = "apt-get install openmpi-bin, or processes = 1."});
  }
  faults.throw_if_any();
  const std::size_t end = printed->find(',', begin);
  return std::make_shared<const LiggghtsSimulator>(
      choice, printed->substr(begin + key.size(), end - begin - key.size()));
}

}  // namespace repose::calibrate
