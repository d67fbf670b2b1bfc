#include <cstdint>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "calibrate/export/conversions.h"
#include "calibrate/export/facts.h"
#include "calibrate/export/target_entry.h"
#include "calibrate/simulators/liggghts_result.h"
#include "calibrate/simulators/liggghts_scene.h"
#include "calibrate/simulators/program_simulator.h"
#include "calibrate/simulators/simulators.h"
#include "dem/contact/model_names.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

/// Version of the decks and of how they are read. Must be raised whenever either changes a run's
/// results.
constexpr int kDecks = 1;

/// LIGGGHTS needs primes above 10000 as seeds, different from those in grain.lig. Consecutive
/// primes up to 2^30 are less than 512 apart, so that each seed below 2^21 gets its own.
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

/// The run as data for an export: a study of this experiment alone.
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

class LiggghtsSimulator : public ProgramSimulator {
 public:
  LiggghtsSimulator(const dem::EngineChoice& choice, std::string version)
      : ProgramSimulator(choice.timeout_s), choice_(choice), version_(std::move(version)) {}

  std::string title() const override {
    return choice_.processes == 1 ? version_
                                  : fmt::format("{}, {} processes", version_, choice_.processes);
  }

  std::string identity(const RunSpec& spec) const override {
    nlohmann::ordered_json json{{"program", kLiggghts}, {"version", version_}, {"decks", kDecks}};
    // A different order of sums and random numbers leads to different trajectories.
    if (processes(spec.entry()) > 1) json["processes"] = processes(spec.entry());
    return json.dump();
  }

  int processes(const dem::ExperimentEntry& entry) const override {
    // Only for heaps. Several processes fill a tube in different layers, which pack denser; with
    // single grains there is nothing to divide.
    return &entry == dem::experiment_of<dem::HeapProtocol>() ? choice_.processes : 1;
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
      // Simultaneous runs would all be bound to the same first cores.
      if (choice_.launcher == "mpirun") words.insert(words.end(), {"--bind-to", "none"});
    }
    // Line-buffered: otherwise its last output before a failure would be lost.
    words.insert(words.end(),
                 {"stdbuf", "-oL", kLiggghts, "-in", dem::name_of(&spec.entry()) + ".lig", "-log",
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
    if (!spec.protocol.as<dem::HeapProtocol>().grains) {
      all.push_back(fmt::format(
          "{} grains are put into the tube, by an estimate of what fills it; ours is filled to "
          "its rim.",
          grains_in_heap(facts)));
    }
    all.emplace_back(
        "The tube, of 96 flat sides, is filled by grains that are placed above each other and fall "
        "all at once; ours rain in layers.");
  }
  if (is_one_of<dem::RollProtocol>(spec.protocol) &&
      spec.model.rolling == dem::RollingModel::elastic_plastic) {
    // The rolling damper of model C, .6 sqrt(k_r I) with k_r ~ k_n ~ sqrt(overlap) (dem/THEORY.md),
    // reduces a spin by the integral of overlap^(1/4) over the duration of a landing. Over Hertz
    // impacts with m x'' = -k x^(3/2) - c x^(1/4) x', up to the end of contact there, up to zero
    // force here, each with its own c for the restitution, it is 1.37 times ours for .31, 1.02
    // times for .9.
    all.emplace_back(
        "A grain that hops as it rolls stops earlier: the rolling damper acts as long as a landing "
        "lasts, which there is longer, as the damper pulls. A ball of 18 mm on steel stops 6 % "
        "earlier with a restitution of 0.31, 4 % with 0.6 and 0.4 % with 0.9; the sample's nut 8 "
        "% with 0.31.");
  }
  if (is_one_of<dem::TiltProtocol>(spec.protocol)) {
    all.emplace_back("Gravity turns in steps of 2 ms in place of the plate.");
    if (spec.model.rolling == dem::RollingModel::relative_constant_torque) {
      // tests/peers/simulator_test.cpp
      all.emplace_back(
          "A body that cdt keeps trembling slides up to .2 degrees later: the tangential damper "
          "there adds to a spring at Coulomb's limit, to which ours is limited, too.");
    }
  }
  return all;
}

dem::Repeat LiggghtsSimulator::read_back(const RunSpec& spec, std::uint64_t seed,
                                         const fs::path& folder) const {
  return liggghts_result(spec, facts_of(spec, seed), seed, folder);
}

}  // namespace

std::shared_ptr<const Simulator> liggghts_simulator(const dem::EngineChoice& choice) {
  base::Faults faults;
  std::string version = installed_liggghts(faults);
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
  return std::make_shared<const LiggghtsSimulator>(choice, std::move(version));
}

}  // namespace repose::calibrate
