#include "cli/simulate/simulate_runs.h"

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "calibrate/experiment/draw_down_front.h"
#include "calibrate/experiment/simulate_experiment.h"
#include "calibrate/experiment/simulator_version.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"
#include "dem/experiment/experiment_table.h"
#include "dem/state/state_file.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path identity_file(const SimulatePlan& plan) { return plan.out_folder / "run.json"; }

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

/// Everything that determines a repeat's bytes except its seed. The study's hash covers the
/// settings.
Json identity_of(const SimulatePlan& plan) {
  return {{"experiment", dem::name_of(plan.experiment)},
          {"study_hash", plan.study.hash},
          {"trajectory_s", plan.trajectory_s ? Json(*plan.trajectory_s) : Json(nullptr)},
          {"simulator_version", calibrate::kSimulatorVersion}};
}

/// How two runs differ, as text.
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

/// Whether the folder's run left something that would be mixed with another run's: a result, files
/// named after a seed, or a restart point. Its failures do not count: the store keeps them apart.
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

/// "FOLDER/heap_seed_3": path of a repeat's files, without extension.
fs::path place_of(const SimulatePlan& plan, std::uint64_t seed) {
  return plan.out_folder / fmt::format("{}_seed_{}", dem::name_of(plan.experiment), seed);
}

/// Files that this run would write and that already exist in a folder that is not repose's: "a, b".
std::string foreign_files(const SimulatePlan& plan) {
  if (calibrate::is_run_store(plan.out_folder) || is_there(plan.out_folder / "study.json")) {
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

/// Records in the folder what its files belong to.
void save_identity(const SimulatePlan& plan) {
  if (plan.out_folder.empty()) return;
  base::write_whole_file(identity_file(plan), identity_of(plan).dump(2) + '\n');
}

/// Threads per repeat: all threads divided among the unfinished repeats.
int threads_each(const SimulatePlan& plan, const std::optional<calibrate::RunStore>& folder) {
  const auto open = std::count_if(plan.seeds.begin(), plan.seeds.end(), [&](std::uint64_t seed) {
    return !folder || !folder->find(plan.spec, seed);
  });
  return std::max(1, plan.threads / std::max(1, static_cast<int>(open)));
}

/// "simulated 34 % of 3 repeats, 12 s left". Any thread may report.
class RepeatsProgress {
 public:
  explicit RepeatsProgress(std::size_t repeats) : fractions_(repeats, 0) {}

  /// Completed fraction of one repeat, 0 to 1.
  void report(std::size_t repeat, double fraction) {
    if (!line_.is_shown()) return;
    const std::lock_guard lock(mutex_);
    fractions_[repeat] = std::clamp(fraction, 0., 1.);
    const std::size_t repeats = fractions_.size();
    const double done =
        std::accumulate(fractions_.begin(), fractions_.end(), 0.) / static_cast<double>(repeats);
    line_.report(fmt::format("simulated {:.0f} % of {} {}", 100 * done, repeats,
                             repeats == 1 ? "repeat" : "repeats"),
                 done);
  }

 private:
  std::mutex mutex_;
  std::vector<double> fractions_;
  ProgressLine line_;
};

/// A heap's first view with the measurement drawn in.
void draw_overlay(const RunFiles& files, const calibrate::HeapViewing& viewing) {
  const calibrate::HeapViewSession session(render::scene_of(dem::read_state(files.state)), viewing);
  render::Renderer renderer;
  session.measure(renderer, 0, files.overlay);
}

/// The front of a draw-down with the measured slopes drawn in.
void draw_front(const RunFiles& files, const dem::BoxesFront& boxes) {
  const calibrate::DrawDownFront front =
      calibrate::draw_down_front(render::scene_of(dem::read_state(files.state)), boxes);
  const std::string title = fs::path(files.overlay).filename().string();
  vision::write_picture(files.overlay,
                        vision::draw_slopes_overlay(front.picture, front.slopes, title));
}

class Batch {
 public:
  Batch(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted)
      : plan_(plan),
        spec_(plan.spec),
        is_interrupted_(is_interrupted),
        progress_(plan.seeds.size()) {
    if (!plan.out_folder.empty()) folder_.emplace(plan.out_folder);
    const int processes = spec_.simulator->processes(spec_.entry());
    spec_.model.threads = std::min(plan.threads, std::max(processes, threads_each(plan, folder_)));
  }

  int runs_at_once() const { return plan_.threads / spec_.model.threads; }

  /// Any error belongs to the repeat and does not end the program.
  void run(std::size_t index) {
    if (is_stopping()) return;
    try {
      simulate(index);
    } catch (const dem::Interrupted&) {
      return;
    } catch (const base::InputError& error) {
      fail({.seed = plan_.seeds[index], .message = error.what()});
    } catch (const std::exception& error) {
      fail({.seed = plan_.seeds[index], .message = error.what(), .is_internal = true});
    }
  }

  Repeats take() {
    Repeats repeats;
    for (auto& [seed, done] : done_) {
      repeats.runs.push_back(std::move(done.first));
      repeats.files.push_back(std::move(done.second));
    }
    std::ranges::sort(errors_, {}, &RepeatError::seed);
    repeats.errors = std::move(errors_);
    return repeats;
  }

 private:
  bool is_stopping() const { return is_interrupted_ || has_failed_; }

  void fail(RepeatError error) {
    has_failed_ = true;
    const std::lock_guard lock(mutex_);
    errors_.push_back(std::move(error));
  }

  void simulate(std::size_t index) {
    const std::uint64_t seed = plan_.seeds[index];
    const std::string place = place_of(plan_, seed).string();
    calibrate::SimulateOptions options;
    options.saves_state = spec_.simulator->has_state(spec_.entry());
    if (folder_) options.folder = &*folder_;
    if (plan_.trajectory_s) options.trajectory = {place, *plan_.trajectory_s};
    options.report = [&](double fraction) {
      progress_.report(index, fraction);
      return !is_stopping();
    };
    calibrate::RunResult run = simulate_experiment(spec_, seed, options);
    progress_.report(index, 1);
    RunFiles files = folder_ ? files_of(run, place) : RunFiles{};
    const std::lock_guard lock(mutex_);
    done_.try_emplace(seed, std::move(run), std::move(files));
  }

  /// Copies the final state next to the store, named after its seed, with a picture of it. A run
  /// without a reading may have no state.
  RunFiles files_of(const calibrate::RunResult& run, const std::string& place) const {
    RunFiles files{.state = place + ".vtp", .overlay = {}};
    if (!spec_.simulator->has_state(spec_.entry())) return {};
    if (!folder_->copy_state(spec_, run.seed, fs::path(files.state).filename().string())) {
      if (!run.failure.empty()) return {};
      throw base::InputError({.where = files.state,
                              .value = fmt::format("its run in {} was changed in the meantime",
                                                   folder_->runs().string()),
                              .fix = "run the same command again."});
    }
    auto* const front = spec_.entry().front;
    if (!run.failure.empty() || (run.views.empty() && front == nullptr)) return files;
    files.overlay = place + ".overlay.png";
    front != nullptr ? draw_front(files, front(spec_.protocol))
                     : draw_overlay(files, spec_.viewing);
    return files;
  }

  const SimulatePlan& plan_;
  calibrate::RunSpec spec_;
  const std::atomic<bool>& is_interrupted_;
  std::optional<calibrate::RunStore> folder_;
  std::atomic<bool> has_failed_{false};
  RepeatsProgress progress_;
  std::mutex mutex_;
  std::map<std::uint64_t, std::pair<calibrate::RunResult, RunFiles>> done_;  ///< by seed
  std::vector<RepeatError> errors_;
};

}  // namespace

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
  const calibrate::RunStore folder(plan.out_folder);
  std::size_t finished = 0, begun = 0;
  for (const std::uint64_t seed : plan.seeds) {
    const bool has_state =
        !plan.spec.simulator->has_state(plan.spec.entry()) || folder.has_state(plan.spec, seed);
    if (folder.find(plan.spec, seed) && has_state) {
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

Repeats run_repeats(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted) {
  save_identity(plan);
  Batch batch(plan, is_interrupted);
  tbb::task_arena arena(batch.runs_at_once());
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, plan.seeds.size(), [&](std::size_t k) { batch.run(k); });
  });
  return batch.take();
}

}  // namespace repose::cli
