#include "calibrate/experiment/run_folder.h"

#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/whole_file.h"
#include "calibrate/experiment/restart_text.h"
#include "dem/state/state_file.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw std::invalid_argument(
      fmt::format("{}: {}. Fix: delete it, and its run starts anew.", file.string(), what));
}

}  // namespace

RunFolder::RunFolder(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(runs(), error);
  if (error) {
    throw std::invalid_argument(
        fmt::format("{}: the folder cannot be made ({}). Fix: choose a place you may write to.",
                    runs().string(), error.message()));
  }
  base::check_can_write(runs() / "run.json");
}

fs::path RunFolder::file(const RunSpec& spec, std::uint64_t seed, const char* ending) const {
  return runs() / (key_of(spec, seed) + ending);
}

std::optional<SimulatedRun> RunFolder::find(const RunSpec& spec, std::uint64_t seed) const {
  const fs::path place = file(spec, seed, ".json");
  const std::optional<std::string> text = base::read_file_if_there(place);
  if (!text) return std::nullopt;
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object() ||
      json.value("simulated", Json()) != Json::parse(description_of(spec, seed))) {
    return std::nullopt;
  }
  return run_in(*text);
}

std::optional<SimulatedRun> RunFolder::find_whole(const RunSpec& spec, std::uint64_t seed) const {
  std::optional<SimulatedRun> run = find(spec, seed);
  if (!run || !run->failure.empty() || spec.views == 0) {
    if (run) run->views.clear();
    return run;
  }
  if (run->views.size() != static_cast<std::size_t>(spec.views)) return std::nullopt;
  return run;
}

void RunFolder::save(const RunSpec& spec, const SimulatedRun& run) const {
  Json json{{"simulated", Json::parse(description_of(spec, run.seed))}};
  json.update(Json::parse(run_text(run)));
  base::write_whole_file(file(spec, run.seed, ".json"), json.dump(2) + '\n');
}

fs::path RunFolder::state_file(const RunSpec& spec, std::uint64_t seed) const {
  return file(spec, seed, ".vtp");
}

bool RunFolder::has_state(const RunSpec& spec, std::uint64_t seed) const {
  return is_there(state_file(spec, seed));
}

bool RunFolder::copy_state(const RunSpec& spec, std::uint64_t seed, const std::string& name) const {
  std::error_code error;
  return fs::copy_file(state_file(spec, seed), folder_ / name, fs::copy_options::overwrite_existing,
                       error);
}

bool RunFolder::has_restart(const RunSpec& spec, std::uint64_t seed) const {
  return is_there(file(spec, seed, ".restart.vtp"));
}

std::optional<SavedRestart> RunFolder::find_restart(const RunSpec& spec, std::uint64_t seed) const {
  const fs::path place = file(spec, seed, ".restart.vtp");
  if (!is_there(place)) return std::nullopt;
  dem::SavedState state = [&] {
    try {
      return dem::read_state(place);
    } catch (const std::invalid_argument&) {
      refuse(place, "it is cut short or was changed");
    }
  }();
  const RestartRecord record = [&] {
    try {
      return restart_in(state.provenance_json, description_of(spec, seed));
    } catch (const std::invalid_argument& error) {
      refuse(place, error.what());
    }
  }();
  return SavedRestart{.from = {.setup = std::move(state.setup),
                               .checkpoint = std::move(state.checkpoint),
                               .progress = record.progress},
                      .record = record};
}

void RunFolder::save_restart(const RunSpec& spec, std::uint64_t seed,
                             const dem::Simulation& simulation, const RestartRecord& record) const {
  dem::write_state(file(spec, seed, ".restart.vtp"), simulation,
                   restart_text(description_of(spec, seed), record));
}

void RunFolder::remove_restart(const RunSpec& spec, std::uint64_t seed) const {
  std::error_code ignored;
  fs::remove(file(spec, seed, ".restart.vtp"), ignored);
}

}  // namespace repose::calibrate
