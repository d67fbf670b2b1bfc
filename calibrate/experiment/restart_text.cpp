#include "calibrate/experiment/restart_text.h"

#include <array>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/input_error.h"

namespace repose::calibrate {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 4> kStages = {"rain", "settle_in_tube", "lift", "settle"};

Json json_of(const dem::HeapProgress& progress) {
  std::vector<double> before;
  for (const dem::Vector& centre : progress.rest.before) {
    before.insert(before.end(), {centre.x(), centre.y(), centre.z()});
  }
  return {{"stage", kStages.at(static_cast<std::size_t>(progress.stage))},
          {"steps", progress.work.steps},
          {"clump_steps", progress.work.clump_steps},
          {"shortest_timestep_s", progress.work.shortest_timestep_s},
          {"steps_left", progress.steps_left},
          {"random_draws", progress.random_draws},
          {"rest_since_s", progress.rest.since_s},
          {"rest_before_m", before},
          {"until_s", progress.until_s},
          {"grains", progress.grains},
          {"start_m", progress.start_m}};
}

dem::HeapStage stage_named(const std::string& name) {
  for (std::size_t k = 0; k < kStages.size(); ++k) {
    if (kStages[k] == name) return static_cast<dem::HeapStage>(k);
  }
  throw base::InputError({.value = "its stage is unknown"});
}

dem::HeapProgress progress_in(const Json& json) {
  dem::HeapProgress progress;
  progress.stage = stage_named(json.at("stage"));
  progress.work = {json.at("steps"), json.at("clump_steps"), json.at("shortest_timestep_s")};
  progress.steps_left = json.at("steps_left");
  progress.random_draws = json.at("random_draws");
  progress.rest.since_s = json.at("rest_since_s");
  const std::vector<double> before = json.at("rest_before_m");
  for (std::size_t k = 0; k + 2 < before.size(); k += 3) {
    progress.rest.before.emplace_back(before[k], before[k + 1], before[k + 2]);
  }
  progress.until_s = json.at("until_s");
  progress.grains = json.at("grains");
  progress.start_m = json.at("start_m");
  return progress;
}

}  // namespace

std::string restart_text(const std::string& description, const RestartRecord& record) {
  const dem::Film& film = record.film;
  return Json{
      {"simulated", Json::parse(description)},
      {"progress", json_of(record.progress)},
      {"film", {{"times_s", film.times_s}, {"start_s", film.start_s}, {"last_s", film.last_s}}},
      {"trajectory_s", record.trajectory_s ? Json(*record.trajectory_s) : Json(nullptr)},
      {"wall_s", record.wall_s}}
      .dump();
}

RestartRecord restart_in(const std::string& text, const std::string& description) {
  try {
    const Json json = Json::parse(text);
    if (json.at("simulated") != Json::parse(description)) {
      throw base::InputError({.value = "it belongs to another run"});
    }
    const Json& film = json.at("film");
    RestartRecord restart;
    restart.progress = progress_in(json.at("progress"));
    restart.film = {film.at("times_s"), film.at("start_s"), film.at("last_s")};
    const Json& trajectory = json.at("trajectory_s");
    if (!trajectory.is_null()) restart.trajectory_s = trajectory.get<double>();
    restart.wall_s = json.at("wall_s");
    return restart;
  } catch (const nlohmann::json::exception&) {
    throw base::InputError({.value = "it is cut short or was changed"});
  }
}

}  // namespace repose::calibrate
