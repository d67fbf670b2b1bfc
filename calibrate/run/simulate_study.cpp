#include "calibrate/run/simulate_study.h"

#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/folder_lock.h"
#include "base/input_error.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/experiment/run_spec.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/experiment/simulate_experiment.h"
#include "calibrate/simulators/simulators.h"
#include "dem/experiment/experiment_table.h"
#include "dem/study/grain_source.h"

namespace repose::calibrate {
namespace {

/// The experiment must be described, and everything it needs must have a value.
void check(const dem::Study& study, const dem::ExperimentEntry& entry) {
  base::Faults faults;
  faults.require(dem::has_protocol(study, &entry),
                 {.where = study.file.string(),
                  .value = fmt::format("section [experiment.{}] is missing", entry.name),
                  .fix = "add it; all its keys have usual values."});
  for (const std::string& key : dem::open_coefficients(study, &entry)) {
    faults.add({.where = study.file.string(),
                .value = fmt::format("{} has bounds but no value, which a simulation needs", key),
                .fix = "give it one, or calibrate the study."});
  }
  faults.throw_if_any();
}

}  // namespace

SimulatedRun simulate_study(const dem::Study& study, std::string_view experiment,
                            std::uint64_t seed, const std::filesystem::path& folder) {
  const dem::ExperimentEntry& entry = dem::experiment_named(experiment);
  check(study, entry);
  RunSpec spec = spec_of(study, &entry, NamedGrain(dem::build_grain(study.grain)), kHeapViews);
  spec.simulator = simulator_for(study);
  if (folder.empty()) {
    return {.result = simulate_experiment(spec, seed, {.trajectory = {}, .report = {}}),
            .state = {}};
  }
  const RunStore store(folder);
  const base::FolderLock lock(folder, lock_file_in(folder));
  SimulatedRun run{.result = simulate_experiment(spec, seed,
                                                 {.folder = &store,
                                                  .saves_state = spec.simulator->has_state(entry),
                                                  .trajectory = {},
                                                  .report = {}}),
                   .state = {}};
  if (store.has_state(spec, seed)) run.state = store.state_file(spec, seed);
  return run;
}

}  // namespace repose::calibrate
