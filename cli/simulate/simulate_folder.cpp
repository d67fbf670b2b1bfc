#include "cli/simulate/simulate_folder.h"

#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/whole_file.h"
#include "calibrate/experiment/run_folder.h"
#include "calibrate/experiment/simulator_version.h"
#include "cli/common/output.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path identity_file(const SimulatePlan& plan) { return plan.out_folder / "run.json"; }

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

/// All that decides over a repeat's bytes but its seed. The study's hash covers the settings.
Json identity_of(const SimulatePlan& plan) {
  return {{"experiment", dem::name_of(plan.experiment)},
          {"study_hash", plan.study.hash},
          {"trajectory_s", plan.trajectory_s ? Json(*plan.trajectory_s) : Json(nullptr)},
          {"simulator_version", calibrate::kSimulatorVersion}};
}

/// What of two runs differs, for people.
std::string difference(const Json& saved, const Json& asked) {
  const auto differs = [&](const char* key) {
    return saved.value(key, Json()) != asked.value(key, Json());
  };
  const auto text = [](const Json& json, const char* key) {
    return json.value(key, Json()).dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  for (const char* key : {"experiment", "simulator_version", "trajectory_s"}) {
    if (differs(key))
      return fmt::format("its {} is {}, not {}", key, text(saved, key), text(asked, key));
  }
  return "the study, its scan or the --set settings were different";
}

/// Whether the run that a folder is of left something that another one would mix with: a result,
/// files named by a seed, or a restart point. Its failures do not: the store tells them apart.
bool holds_results(const fs::path& folder, const Json& saved) {
  const Json named = saved.value("experiment", Json());
  const std::string experiment = named.is_string() ? named.get<std::string>() : std::string();
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name == "result.json" || name == experiment + ".json") return true;
    if (name.starts_with(experiment + "_seed_")) return true;
  }
  return calibrate::has_unfinished_runs(folder);
}

/// Names that this run writes and that are there, in a folder that is none of repose: "a, b".
std::string foreign_files(const SimulatePlan& plan) {
  if (calibrate::is_run_folder(plan.out_folder) || is_there(plan.out_folder / "study.json")) {
    return {};
  }
  std::vector<std::string> foreign;
  if (is_there(result_file(plan))) foreign.push_back(result_file(plan).filename().string());
  for (const std::uint64_t seed : plan.seeds) {
    for (const char* ending : {".vtp", ".overlay.png", ""}) {
      const fs::path file = place_of(plan, seed).string() + ending;
      if (is_there(file)) foreign.push_back(file.filename().string());
    }
  }
  return fmt::format("{}", fmt::join(foreign, ", "));
}

}  // namespace

fs::path place_of(const SimulatePlan& plan, std::uint64_t seed) {
  return plan.out_folder / fmt::format("{}_seed_{}", dem::name_of(plan.experiment), seed);
}

fs::path result_file(const SimulatePlan& plan) {
  const bool is_of_study = is_there(plan.out_folder / "study.json");
  return plan.out_folder /
         (is_of_study ? dem::name_of(plan.experiment) + ".json" : std::string("result.json"));
}

std::string error_of_saved(const SimulatePlan& plan) {
  const fs::path file = identity_file(plan);
  if (plan.out_folder.empty()) return {};
  if (!is_there(file)) {
    const std::string foreign = foreign_files(plan);
    if (foreign.empty()) return {};
    return fmt::format(
        "--out {}: not a folder of repose simulate, and your own files would be overwritten: {}. "
        "Fix: choose another folder, or move them away.",
        plan.out_folder.string(), foreign);
  }
  const Json saved = Json::parse(base::read_whole_file(file), nullptr, false);
  const Json asked = identity_of(plan);
  if (saved == asked || (saved.is_object() && !holds_results(plan.out_folder, saved))) return {};
  return fmt::format(
      "--out {}: contains a different run: {}. Fix: choose another folder, or delete this one.",
      plan.out_folder.string(),
      saved.is_object() ? difference(saved, asked) : "run.json was changed");
}

std::vector<std::string> notes_on_saved(const SimulatePlan& plan) {
  if (plan.out_folder.empty()) return {};
  const calibrate::RunFolder folder(plan.out_folder);
  std::size_t finished = 0, begun = 0;
  for (const std::uint64_t seed : plan.seeds) {
    if (folder.find(plan.spec, seed) && folder.has_state(plan.spec, seed)) {
      ++finished;
    } else if (folder.has_restart(plan.spec, seed)) {
      ++begun;
    }
  }
  std::vector<std::string> notes = folder.remarks();
  if (finished + begun == 0) return notes;
  notes.push_back(fmt::format(
      "{}: resuming an earlier run: of {} {} {} finished, {} in progress. (To start over, "
      "delete the folder.)",
      plan.out_folder.string(), plan.seeds.size(), plan.seeds.size() == 1 ? "repeat" : "repeats",
      finished, begun));
  return notes;
}

void save_identity(const SimulatePlan& plan) {
  if (plan.out_folder.empty()) return;
  base::write_whole_file(identity_file(plan), identity_of(plan).dump(2) + '\n');
}

}  // namespace repose::cli
