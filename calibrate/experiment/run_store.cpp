#include "calibrate/experiment/run_store.h"

#include <mutex>
#include <optional>
#include <regex>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "calibrate/experiment/json_fields.h"
#include "dem/state/state_file.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

constexpr const char* kChanged = "it is cut short, was changed, or is of an earlier version";

constexpr const char* kRestartEnding = ".restart.vtp";

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

/// Whether the folder's store has a name for which `is_meant` is true.
template <typename IsMeant>
bool has_stored(const fs::path& folder, const IsMeant& is_meant) {
  std::error_code error;
  for (fs::directory_iterator entry(folder / "runs", error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_meant(entry->path().filename().string())) return true;
  }
  return false;
}

/// Names of an experiment's stages.
using Stages = std::span<const std::string_view>;

Json json_of(const dem::RunProgress& progress, Stages stages) {
  std::vector<double> before;
  for (const dem::Vector& centre : progress.rest.before) {
    before.insert(before.end(), {centre.x(), centre.y(), centre.z()});
  }
  return {{"stage", stages[static_cast<std::size_t>(progress.stage)]},
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

int stage_named(const std::string& name, Stages stages) {
  for (std::size_t k = 0; k < stages.size(); ++k) {
    if (stages[k] == name) return static_cast<int>(k);
  }
  throw base::InputError({.value = "its stage is unknown"});
}

dem::RunProgress progress_in(const Json& json, Stages stages) {
  dem::RunProgress progress;
  progress.stage = stage_named(json.at("stage"), stages);
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

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  base::refuse(file, what, "delete it, and its run starts again.");
}

}  // namespace

std::string restart_text(const std::string& description, const RestartRecord& record,
                         std::span<const std::string_view> stages) {
  const dem::Film& film = record.film;
  return Json{
      {"simulated", Json::parse(description)},
      {"progress", json_of(record.progress, stages)},
      {"film", {{"times_s", film.times_s}, {"start_s", film.start_s}, {"last_s", film.last_s}}},
      {"trajectory_s", record.trajectory_s ? Json(*record.trajectory_s) : Json(nullptr)},
      {"wall_s", record.wall_s}}
      .dump();
}

RestartRecord restart_in(const std::string& text, const std::string& description,
                         std::span<const std::string_view> stages) {
  try {
    const Json json = Json::parse(text);
    if (json.at("simulated") != Json::parse(description)) {
      throw base::InputError({.value = "it belongs to another run"});
    }
    const Json& film = json.at("film");
    RestartRecord restart;
    restart.progress = progress_in(json.at("progress"), stages);
    restart.film = {film.at("times_s"), film.at("start_s"), film.at("last_s")};
    const Json& trajectory = json.at("trajectory_s");
    if (!trajectory.is_null()) restart.trajectory_s = trajectory.get<double>();
    restart.wall_s = json.at("wall_s");
    return restart;
  } catch (const nlohmann::json::exception&) {
    throw base::InputError({.value = "it is cut short or was changed"});
  }
}

/// Any thread may add remarks.
struct RunStore::Remarks {
  std::mutex mutex;
  std::set<std::string> lines;
};

RunStore::RunStore(fs::path folder)
    : folder_(std::move(folder)), remarks_(std::make_shared<Remarks>()) {
  std::error_code error;
  fs::create_directories(runs(), error);
  if (error) {
    base::refuse(runs(), fmt::format("the folder cannot be created ({})", error.message()),
                 "choose a writable place.");
  }
  base::check_can_write(runs() / "run.json");
  base::remove_leftovers_in(runs());
}

fs::path RunStore::file(const RunSpec& spec, std::uint64_t seed, const char* ending) const {
  fs::path place = runs() / (key_of(spec, seed) + ending);
  if (std::error_code ignored; fs::is_directory(place, ignored)) {
    throw StoreError({.where = place.string(),
                      .value = "is a folder, and a stored run is a file of that name",
                      .fix = "move it away."});
  }
  return place;
}

std::optional<RunResult> RunStore::find(const RunSpec& spec, std::uint64_t seed) const {
  const fs::path place = file(spec, seed, ".json");
  const std::optional<std::string> text = base::read_file_if_there(place);
  if (!text) return std::nullopt;
  try {
    RunResult run = run_in(*text);
    if (run.seed != seed || run.simulated != description_of(spec, seed)) {
      throw base::InputError({.value = "it is of another run"});
    }
    run.definition = spec.definition;
    return run;
  } catch (const base::InputError& error) {
    note_damaged(place, error.what());
    return std::nullopt;
  }
}

void RunStore::note_damaged(const fs::path& file, const std::string& reason) const {
  note(fmt::format("{}: {}. It is not used; its run is simulated again.", file.string(), reason));
}

void RunStore::note(const std::string& line) const {
  const std::lock_guard lock(remarks_->mutex);
  remarks_->lines.insert(line);
}

std::vector<std::string> RunStore::remarks() const {
  const std::lock_guard lock(remarks_->mutex);
  return {remarks_->lines.begin(), remarks_->lines.end()};
}

std::optional<RunResult> RunStore::find_whole(const RunSpec& spec, std::uint64_t seed) const {
  std::optional<RunResult> run = find(spec, seed);
  if (run && !has_definition(*run, spec.definition)) return std::nullopt;
  if (!run || !run->failure.empty() || spec.viewing.views == 0) {
    if (run) run->views.clear();
    return run;
  }
  if (!is_pictured_as(*run, spec.viewing)) return std::nullopt;
  return run;
}

void RunStore::save(const RunSpec& spec, const RunResult& run) const {
  base::write_whole_file(file(spec, run.seed, ".json"), text_of(run));
}

fs::path RunStore::state_file(const RunSpec& spec, std::uint64_t seed) const {
  return file(spec, seed, ".vtp");
}

bool RunStore::has_state(const RunSpec& spec, std::uint64_t seed) const {
  const fs::path place = state_file(spec, seed);
  if (!is_there(place)) return false;
  if (dem::is_as_written(place)) return true;
  note_damaged(place, kChanged);
  return false;
}

bool RunStore::copy_state(const RunSpec& spec, std::uint64_t seed, const std::string& name) const {
  if (!has_state(spec, seed)) return false;
  base::write_whole_file(folder_ / name, base::read_whole_file(state_file(spec, seed)));
  return true;
}

fs::path RunStore::work_folder(const RunSpec& spec, std::uint64_t seed) const {
  return runs() / (key_of(spec, seed) + ".work");
}

bool RunStore::has_restart(const RunSpec& spec, std::uint64_t seed) const {
  return is_there(file(spec, seed, kRestartEnding));
}

std::optional<SavedRestart> RunStore::find_restart(const RunSpec& spec, std::uint64_t seed) const {
  const fs::path place = file(spec, seed, kRestartEnding);
  if (!is_there(place)) return std::nullopt;
  if (!dem::is_as_written(place)) refuse(place, kChanged);
  dem::SavedState state = [&] {
    try {
      return dem::read_state(place);
    } catch (const base::InputError&) {
      refuse(place, kChanged);
    }
  }();
  const RestartRecord record = [&] {
    try {
      return restart_in(state.provenance_json, description_of(spec, seed), spec.entry().stages);
    } catch (const base::InputError& error) {
      refuse(place, error.what());
    }
  }();
  return SavedRestart{.from = {.setup = std::move(state.setup),
                               .checkpoint = std::move(state.checkpoint),
                               .progress = record.progress},
                      .record = record};
}

void RunStore::save_restart(const RunSpec& spec, std::uint64_t seed,
                            const dem::Simulation& simulation, const RestartRecord& record) const {
  dem::write_state(file(spec, seed, kRestartEnding), simulation,
                   restart_text(description_of(spec, seed), record, spec.entry().stages));
}

fs::path lock_file_in(const fs::path& folder) { return folder / "runs" / ".lock"; }

bool is_run_store(const fs::path& folder) {
  if (is_there(lock_file_in(folder))) return true;
  static const std::regex key("[a-z]+-[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}[.].+");
  return has_stored(folder, [](const std::string& name) { return std::regex_match(name, key); });
}

bool has_unfinished_runs(const fs::path& folder) {
  return has_stored(folder, [](const std::string& name) { return name.ends_with(kRestartEnding); });
}

void RunStore::remove_restart(const RunSpec& spec, std::uint64_t seed) const {
  std::error_code ignored;
  fs::remove(file(spec, seed, kRestartEnding), ignored);
}

}  // namespace repose::calibrate
