#include "calibrate/study/study_simulator.h"

#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/fingerprint.h"
#include "calibrate/study/coefficients.h"
#include "calibrate/study/heap_views.h"
#include "calibrate/study/position_angle.h"
#include "dem/contact/rolling_name.h"
#include "dem/engine/unstable_run.h"
#include "dem/state/state_file.h"

namespace repose::calibrate {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 4> kNames = {"drop", "tilt", "roll", "heap"};

Json json_of(const dem::Material& material) {
  return {{"density_kg_m3", material.density_kg_m3},
          {"young_modulus_pa", material.young_modulus_pa},
          {"poisson_ratio", material.poisson_ratio}};
}

Json json_of(const dem::PairCoefficients& pair) {
  return {{"restitution", pair.restitution},
          {"sliding_friction", pair.sliding_friction},
          {"rolling_friction", pair.rolling_friction}};
}

Json protocol_json(const dem::Study& study, dem::Experiment experiment, int heap_views) {
  switch (experiment) {
    case dem::Experiment::drop:
      return {{"height_m", study.drop->height_m}, {"grains", study.drop->grains}};
    case dem::Experiment::tilt:
      return {{"bonded", study.tilt->bonded},
              {"rate_deg_s", study.tilt->rate_deg_s},
              {"start_deg", study.tilt->start_deg}};
    case dem::Experiment::roll:
      return {{"incline_deg", study.roll->incline_deg}, {"release_m", study.roll->release_m}};
    case dem::Experiment::heap:
      break;
  }
  const dem::HeapProtocol& heap = *study.heap;
  return {{"tube_diameter_m", heap.tube_diameter_m},
          {"tube_height_m", heap.tube_height_m},
          {"tube_thickness_m", heap.tube_thickness_m},
          {"lift_speed_m_s", heap.lift_speed_m_s},
          {"plate_m", heap.plate_m},
          {"plate_thickness_m", heap.plate_thickness_m},
          {"grains", heap.grains ? Json(*heap.grains) : Json(nullptr)},
          {"may_be_fewer", heap.may_be_fewer},
          {"views", heap_views}};
}

dem::Repeat run_experiment(const dem::Study& study, const dem::Model& model,
                           dem::Experiment experiment, std::uint64_t seed,
                           const dem::ProgressReport& report) {
  switch (experiment) {
    case dem::Experiment::drop:
      return run_drop(model, *study.drop, seed, report);
    case dem::Experiment::tilt:
      return run_tilt(model, *study.tilt, seed, report);
    case dem::Experiment::roll:
      return run_roll(model, *study.roll, seed, report);
    case dem::Experiment::heap:
      break;
  }
  dem::Repeat heap = run_heap(model, *study.heap, seed, report);
  add_position_angle(heap);
  return heap;
}

/// A reading that does not exist is not there, never NaN.
void leave_out_missing(Run& run) {
  std::erase_if(run.readings, [](const auto& reading) { return !std::isfinite(reading.second); });
  if (run.readings.contains("value")) return;
  run.readings.clear();
  run.failure = "it has no value";
}

}  // namespace

std::string name_of(dem::Experiment experiment) {
  return kNames[static_cast<std::size_t>(experiment)];
}

dem::Experiment experiment_named(const std::string& name) {
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    if (name == kNames[k]) return static_cast<dem::Experiment>(k);
  }
  throw std::invalid_argument(fmt::format(
      "experiment {}: there is no such experiment. Fix: drop, tilt, roll or heap.", name));
}

StudySimulator::StudySimulator(dem::Study study, dem::ClumpFile grain,
                               std::vector<std::string> names, int heap_views)
    : study_(std::move(study)),
      grain_fingerprint_(base::fingerprint({dem::clump_json(grain)})),
      names_(std::move(names)),
      heap_views_(heap_views) {
  study_.model.grain = std::move(grain.shape);
  study_.model.threads = 1;
  if (study_.heap) study_.heap->may_be_fewer = true;
}

dem::Model StudySimulator::model_for(const Job& job) const {
  dem::Model model = dem::model_for(study_, experiment_named(job.experiment));
  for (std::size_t k = 0; k < names_.size(); ++k) {
    coefficient_named(names_[k], model) = job.values.at(k);
  }
  return model;
}

std::string StudySimulator::description(const Job& job) const {
  const dem::Experiment experiment = experiment_named(job.experiment);
  const dem::Model model = model_for(job);
  Json json{{"experiment", job.experiment},
            {"protocol", protocol_json(study_, experiment, heap_views_)},
            {"grain", grain_fingerprint_},
            {"particle", json_of(model.grain_material)},
            {"wall", json_of(model.wall_material)},
            {"particle_wall", json_of(model.grain_wall)}};
  if (experiment == dem::Experiment::heap) json["particle_particle"] = json_of(model.grain_grain);
  json["rolling_model"] = dem::name_of(model.rolling);
  json["stiffness_factor"] = model.stiffness_factor;
  json["timestep_fraction"] = model.timestep_fraction;
  json["timestep_s"] = model.timestep_s ? Json(*model.timestep_s) : Json(nullptr);
  json["seed"] = job.seed;
  json["program"] = REPOSE_SIMULATOR;
  return json.dump();
}

std::string StudySimulator::key(const Job& job) const {
  return job.experiment + '-' + base::fingerprint({description(job)});
}

void StudySimulator::take_pictures(const dem::Repeat& repeat, Run& run) const {
  run.readings["angle_from_positions_deg"] = repeat.value;
  if (heap_views_ == 0) return;
  render::Renderer renderer;
  const HeapViewSession session(render::scene_of(*repeat.state), heap_views_);
  std::vector<HeapView> views;
  views.reserve(static_cast<std::size_t>(heap_views_));
  for (int view = 0; view < heap_views_; ++view) views.push_back(session.measure(renderer, view));
  run.readings["views_measured"] = heap_views_ - count(views, vision::MeasureStatus::refused);
  const bool is_pictured = is_well_pictured(views);
  run.readings["from_pictures"] = is_pictured ? 1 : 0;
  const auto angle = angle_deg(views);
  if (!angle) return;
  run.readings["angle_from_pictures_deg"] = angle->mean;
  if (angle->sd) run.readings["sd_between_views_deg"] = *angle->sd;
  if (is_pictured) run.readings["value"] = angle->mean;
}

SimulatedJob StudySimulator::simulate(const Job& job,
                                      const std::atomic<bool>& is_interrupted) const {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const dem::Experiment experiment = experiment_named(job.experiment);
  SimulatedJob result{.run = {.job = job, .readings = {}, .failure = {}}, .wall_s = 0};
  try {
    const dem::Repeat repeat =
        run_experiment(study_, model_for(job), experiment, job.seed,
                       [&](double, const dem::Simulation&) { return !is_interrupted; });
    result.run.readings = repeat.readings;
    result.run.readings["value"] = repeat.value;
    result.run.readings["timestep_s"] = repeat.timestep_s;
    if (experiment == dem::Experiment::heap) {
      take_pictures(repeat, result.run);
      if (!state_folder_.empty()) {
        dem::write_state(state_folder_ / (key(job) + ".vtp"), *repeat.state, description(job));
      }
    }
    leave_out_missing(result.run);
  } catch (const dem::NoReading& error) {
    result.run.failure = error.what();
  } catch (const dem::UnstableRun& error) {
    result.run.failure = error.what();
  }
  result.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

}  // namespace repose::calibrate
