#include "calibrate/study/study_simulator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "base/input_error.h"
#include "dem/experiment/experiment_table.h"
#include "dem/study/held_inputs.h"

namespace repose::calibrate {

namespace {

struct Place {
  const char* name;
  dem::Coefficient dem::CoefficientSet::*in_study;
  double dem::PairCoefficients::*in_bench;
};

constexpr std::array<Place, 4> kPlaces = {{
    {"restitution", &dem::CoefficientSet::restitution, &dem::PairCoefficients::restitution},
    {"sliding_friction", &dem::CoefficientSet::sliding_friction,
     &dem::PairCoefficients::sliding_friction},
    {"rolling_friction", &dem::CoefficientSet::rolling_friction,
     &dem::PairCoefficients::rolling_friction},
    {"restitution_exponent", &dem::CoefficientSet::restitution_exponent,
     &dem::PairCoefficients::restitution_exponent},
}};

std::string prefix_of(dem::WallPart part) { return "contact.particle_" + name_of(part) + '.'; }

constexpr const char* kWall = "contact.particle_wall.";
constexpr const char* kParticle = "contact.particle_particle.";

}  // namespace

std::vector<NamedCoefficient> coefficients_of(const dem::Study& study) {
  std::vector<NamedCoefficient> all;
  for (const Place& place : kPlaces) {
    all.push_back({std::string(kWall) + place.name, study.particle_wall.*place.in_study});
  }
  for (const Place& place : kPlaces) {
    all.push_back({std::string(kParticle) + place.name, study.particle_particle.*place.in_study});
  }
  for (const auto& [part, set] : study.particle_parts) {
    for (const Place& place : kPlaces) {
      all.push_back({prefix_of(part) + place.name, set.*place.in_study});
    }
  }
  return all;
}

double* find_coefficient(const std::string& name, dem::Model& model) {
  for (const Place& place : kPlaces) {
    if (name == std::string(kWall) + place.name) return &(model.grain_wall.*place.in_bench);
    if (name == std::string(kParticle) + place.name) return &(model.grain_grain.*place.in_bench);
    for (auto& [part, surface] : model.parts) {
      if (name == prefix_of(part) + place.name) return &(surface.with_grain.*place.in_bench);
    }
  }
  return nullptr;
}

double& coefficient_named(const std::string& name, dem::Model& model) {
  double* found = find_coefficient(name, model);
  if (found != nullptr) return *found;
  throw base::InputError({.where = name, .value = "there is no such coefficient"});
}

Run run_of(const Job& job, const RunResult& result) {
  Run run{.job = job, .readings = readings_of(result), .failure = result.failure};
  if (run.failure.empty() && !run.readings.contains("value")) {
    run.readings.clear();
    run.failure =
        base::is_usual_definition(result.definition)
            ? "it has no value"
            : fmt::format("its angle cannot be measured by the definition {}", result.definition);
  }
  return run;
}

/// By the number of spheres, and the changed input of the study.
struct StudySimulator::FinerGrains {
  struct Grain {
    explicit Grain(const dem::ClumpFile& made) : file(made), named(made) {}
    dem::ClumpFile file;
    NamedGrain named;
  };

  std::mutex making;
  std::map<std::pair<int, InputStep>, Grain> made;
  std::map<std::pair<std::string, double>, Grain> larger;

  const Grain& of(dem::GrainSource source, int spheres, const InputStep& step) {
    const std::scoped_lock lock(making);
    const auto key = std::pair(spheres, step);
    const auto found = made.find(key);
    if (found != made.end()) return found->second;
    source.fill.spheres = spheres;
    source.fill.volume_error.reset();
    return made.try_emplace(key, dem::build_grain(source)).first->second;
  }

  /// The same clump, larger.
  const Grain& scaled(const dem::ClumpFile& clump, const std::string& fingerprint, double size) {
    const std::scoped_lock lock(making);
    const auto key = std::pair(fingerprint, size);
    const auto found = larger.find(key);
    if (found != larger.end()) return found->second;
    dem::ClumpFile scaled = clump;
    dem::scale(scaled, size);
    Grain& grain = larger.try_emplace(key, scaled).first->second;
    grain.named.size = size;
    return grain;
  }
};

StudySimulator::StudySimulator(dem::Study study, dem::ClumpFile grain,
                               const std::vector<Parameter>& sought, int heap_views)
    : study_(std::move(study)),
      study_grain_(std::move(grain)),
      grain_(study_grain_),
      finer_(std::make_shared<FinerGrains>()),
      heap_views_(heap_views) {
  for (const Parameter& parameter : sought) names_.push_back(parameter.name);
  study_.model.threads = 1;
}

int StudySimulator::spheres(double multiple) const {
  return static_cast<int>(std::lround(multiple * static_cast<double>(grain_.shape.spheres.size())));
}

const dem::ClumpFile& StudySimulator::finer_grain(double multiple) const {
  return finer_->of(study_.grain, spheres(multiple), {}).file;
}

const NamedGrain& StudySimulator::grain(const dem::GrainSource& source,
                                        const AssumedInputs& inputs) const {
  const bool is_other = source.size_factor != study_.grain.size_factor ||
                        (source.sizes && *source.sizes != *study_.grain.sizes);
  const bool is_own = inputs.spheres == 1 && !is_other;
  if (is_own && inputs.size == 1) return grain_;
  if (is_own) return finer_->scaled(study_grain_, grain_.fingerprint, inputs.size).named;
  const FinerGrains::Grain& made =
      finer_->of(source, spheres(inputs.spheres), is_other ? inputs.step : InputStep{});
  if (inputs.size == 1) return made.named;
  return finer_->scaled(made.file, made.named.fingerprint, inputs.size).named;
}

RunSpec StudySimulator::spec(const Job& job) const {
  const dem::Experiment experiment = &dem::experiment_named(job.experiment);
  const InputStep& step = job.inputs.step;
  std::optional<dem::Study> changed;
  if (!step.input.empty()) dem::change_input(changed.emplace(study_), step.input, step.change);
  const dem::Study& study = changed ? *changed : study_;
  RunSpec spec = spec_of(study, experiment, grain(study.grain, job.inputs), heap_views_);
  if (job.inputs.size != 1) experiment->coarsen(spec.protocol, job.inputs.size);
  spec.simulator = simulator_;
  spec.model.stiffness_factor = std::min(1., spec.model.stiffness_factor * job.inputs.stiffness);
  for (std::size_t k = 0; k < names_.size(); ++k) {
    // An experiment without a part has none of the part's coefficients.
    double* coefficient = find_coefficient(names_[k], spec.model);
    if (coefficient != nullptr) *coefficient = job.values.at(k);
  }
  return spec;
}

RunResult StudySimulator::simulate(const Job& job, const std::atomic<bool>& is_interrupted) const {
  const SimulateOptions options{
      .folder = folder_, .trajectory = {}, .report = [&](double) { return !is_interrupted; }};
  RunResult result = simulate_experiment(spec(job), job.seed, options);
  if (!result.picture_error.empty()) {
    throw std::runtime_error(
        fmt::format("no pictures of heaps can be drawn: {}", result.picture_error));
  }
  return result;
}

}  // namespace repose::calibrate
