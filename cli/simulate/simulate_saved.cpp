#include "cli/simulate/simulate_saved.h"

#include <array>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/whole_file.h"
#include "cli/common/output.h"
#include "cli/simulate/simulate_names.h"
#include "dem/state/state_file.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 4> kStages = {"rain", "settle_in_tube", "lift", "settle"};

fs::path identity_file(const SimulatePlan& plan) { return plan.out_folder / "run.json"; }

fs::path file_of(const SimulatePlan& plan, std::uint64_t seed, std::string_view ending) {
  return place_of(plan, seed).string() + std::string(ending);
}
fs::path state_file(const SimulatePlan& plan, std::uint64_t seed) {
  return file_of(plan, seed, ".vtp");
}
fs::path finished_file(const SimulatePlan& plan, std::uint64_t seed) {
  return file_of(plan, seed, ".json");
}
fs::path restart_file(const SimulatePlan& plan, std::uint64_t seed) {
  return file_of(plan, seed, ".restart.vtp");
}

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

bool is_finished(const SimulatePlan& plan, std::uint64_t seed) {
  return is_there(finished_file(plan, seed)) && is_there(state_file(plan, seed));
}

/// All that decides over a repeat's bytes but its seed. The study's hash covers the settings.
Json identity_of(const SimulatePlan& plan) {
  return {{"experiment", names_of(plan.experiment).name},
          {"study_hash", plan.study.hash},
          {"trajectory_s", plan.trajectory_s ? Json(*plan.trajectory_s) : Json(nullptr)},
          {"program", REPOSE_SIMULATOR}};
}

Json identity_of(const SimulatePlan& plan, std::uint64_t seed) {
  Json identity = identity_of(plan);
  identity["seed"] = seed;
  return identity;
}

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw std::invalid_argument(
      fmt::format("{}: {}. Fix: delete it, and its repeat starts anew.", file.string(), what));
}

/// Reads what a file holds; `file` is what errors call it.
template <typename Read>
auto checked(const fs::path& file, const Json& identity, const std::string& text,
             const Read& read) {
  try {
    const Json json = Json::parse(text);
    if (json.at("identity") != identity) refuse(file, "it belongs to another run");
    return read(json);
  } catch (const nlohmann::json::exception&) {
    refuse(file, "it is cut short or was changed");
  }
}

double number_or_nan(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Json json_of(const dem::HeapProgress& progress) {
  std::vector<double> before;
  for (const dem::Vector& centre : progress.rest.before) {
    before.insert(before.end(), {centre.x(), centre.y(), centre.z()});
  }
  return {{"stage", kStages[static_cast<std::size_t>(progress.stage)]},
          {"steps", progress.work.steps},
          {"clump_steps", progress.work.clump_steps},
          {"steps_left", progress.steps_left},
          {"random_draws", progress.random_draws},
          {"rest_since_s", progress.rest.since_s},
          {"rest_before_m", before},
          {"until_s", progress.until_s},
          {"grains", progress.grains},
          {"start_m", progress.start_m}};
}

dem::HeapStage stage_named(const std::string& name, const fs::path& file) {
  for (std::size_t k = 0; k < kStages.size(); ++k) {
    if (kStages[k] == name) return static_cast<dem::HeapStage>(k);
  }
  refuse(file, "its stage is none that is known");
}

dem::HeapProgress progress_in(const Json& json, const fs::path& file) {
  dem::HeapProgress progress;
  progress.stage = stage_named(json.at("stage"), file);
  progress.work = {json.at("steps"), json.at("clump_steps")};
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

/// What of two runs differs, for people.
std::string difference(const Json& saved, const Json& asked) {
  const auto differs = [&](const char* key) {
    return saved.value(key, Json()) != asked.value(key, Json());
  };
  const auto text = [](const Json& json, const char* key) {
    return json.value(key, Json()).dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  for (const char* key : {"experiment", "program", "trajectory_s"}) {
    if (differs(key))
      return fmt::format("its {} is {}, not {}", key, text(saved, key), text(asked, key));
  }
  return "the study, its scan or the --set settings were other ones";
}

}  // namespace

fs::path place_of(const SimulatePlan& plan, std::uint64_t seed) {
  return plan.out_folder / fmt::format("{}_seed_{}", names_of(plan.experiment).name, seed);
}

std::string error_of_saved(const SimulatePlan& plan) {
  const fs::path file = identity_file(plan);
  if (plan.out_folder.empty() || !is_there(file)) return {};
  const Json saved = Json::parse(base::read_whole_file(file), nullptr, false);
  const Json asked = identity_of(plan);
  if (saved == asked) return {};
  return fmt::format(
      "--out {}: it holds another run: {}. Fix: another folder, or delete this one to start anew.",
      plan.out_folder.string(),
      saved.is_object() ? difference(saved, asked) : "run.json was changed");
}

std::string saved_text(const SimulatePlan& plan) {
  if (plan.out_folder.empty()) return {};
  std::size_t finished = 0, begun = 0;
  for (const std::uint64_t seed : plan.seeds) {
    if (is_finished(plan, seed)) {
      ++finished;
    } else if (is_there(restart_file(plan, seed))) {
      ++begun;
    }
  }
  if (finished + begun == 0) return {};
  return fmt::format(
      "{}: goes on with an earlier run: of {} {} {} finished already, {} under way. (To start "
      "anew, delete the folder.)",
      plan.out_folder.string(), plan.seeds.size(), plan.seeds.size() == 1 ? "repeat" : "repeats",
      finished, begun);
}

void save_identity(const SimulatePlan& plan) {
  if (plan.out_folder.empty()) return;
  write_output(identity_file(plan).string(), identity_of(plan).dump(2) + '\n');
}

void save_finished(const SimulatePlan& plan, const Run& run) {
  const dem::Repeat& repeat = run.repeat;
  const Json json{{"identity", identity_of(plan, repeat.seed)},
                  {"value", repeat.value},
                  {"steps", repeat.steps},
                  {"clump_steps", repeat.clump_steps},
                  {"timestep_s", repeat.timestep_s},
                  {"readings", repeat.readings},
                  {"wall_s", run.wall_s}};
  write_output(finished_file(plan, repeat.seed).string(), json.dump(2) + '\n');
  std::error_code ignored;
  fs::remove(restart_file(plan, repeat.seed), ignored);
}

void save_restart(const SimulatePlan& plan, std::uint64_t seed, const dem::Simulation& simulation,
                  const dem::HeapProgress& progress, const dem::Film& film, double wall_s) {
  const Json json{
      {"identity", identity_of(plan, seed)},
      {"progress", json_of(progress)},
      {"film", {{"times_s", film.times_s}, {"start_s", film.start_s}, {"last_s", film.last_s}}},
      {"wall_s", wall_s}};
  write_state(restart_file(plan, seed), simulation, json.dump());
}

std::optional<Run> saved_run(const SimulatePlan& plan, std::uint64_t seed) {
  if (plan.out_folder.empty() || !is_finished(plan, seed)) return std::nullopt;
  const fs::path file = finished_file(plan, seed);
  return checked(file, identity_of(plan, seed), base::read_whole_file(file), [&](const Json& json) {
    Run run;
    run.outcome = RunOutcome::done;
    run.repeat = {.value = number_or_nan(json.at("value")),
                  .seed = seed,
                  .steps = json.at("steps"),
                  .timestep_s = json.at("timestep_s"),
                  .clump_steps = json.at("clump_steps"),
                  .readings = {},
                  .state = {}};
    for (const auto& [name, value] : json.at("readings").items()) {
      run.repeat.readings[name] = number_or_nan(value);
    }
    run.state_file = state_file(plan, seed).string();
    run.wall_s = json.at("wall_s");
    return run;
  });
}

std::optional<SavedRestart> saved_restart(const SimulatePlan& plan, std::uint64_t seed) {
  const fs::path file = restart_file(plan, seed);
  if (plan.out_folder.empty() || !is_there(file)) return std::nullopt;
  dem::SavedState state = [&] {
    try {
      return dem::read_state(file);
    } catch (const std::invalid_argument&) {
      refuse(file, "it is cut short or was changed");
    }
  }();
  return checked(file, identity_of(plan, seed), state.provenance_json, [&](const Json& json) {
    const Json& film = json.at("film");
    return SavedRestart{.from = {.setup = std::move(state.setup),
                                 .checkpoint = std::move(state.checkpoint),
                                 .progress = progress_in(json.at("progress"), file)},
                        .film = {film.at("times_s"), film.at("start_s"), film.at("last_s")},
                        .wall_s = json.at("wall_s")};
  });
}

}  // namespace repose::cli
