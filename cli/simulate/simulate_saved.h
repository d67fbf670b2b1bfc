#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/simulate/simulate_runs.h"
#include "dem/state/trajectory.h"

/// What a `repose simulate --out FOLDER` keeps there, for the next call to go on from:
/// run.json says what it belongs to, EXPERIMENT_seed_N.json is a finished repeat's reading,
/// EXPERIMENT_seed_N.restart.vtp is where an unfinished one stood.
namespace repose::cli {

/// A repeat on its way.
struct SavedRestart {
  dem::HeapRestart from;
  dem::Film film;
  double wall_s = 0;
};

/// "FOLDER/heap_seed_3": what a repeat's files are called, without their endings.
std::filesystem::path place_of(const SimulatePlan& plan, std::uint64_t seed);

/// What is wrong with going on with what the folder holds: another run's files. Empty: nothing is.
std::string error_of_saved(const SimulatePlan& plan);

/// What there is to go on from, as a sentence; empty when there is nothing.
std::string saved_text(const SimulatePlan& plan);

/// Says in the folder what its files belong to.
void save_identity(const SimulatePlan& plan);

/// A repeat that is done needs no restart point any more.
void save_finished(const SimulatePlan& plan, const Run& run);
void save_restart(const SimulatePlan& plan, std::uint64_t seed, const dem::Simulation& simulation,
                  const dem::HeapProgress& progress, const dem::Film& film, double wall_s);

/// None when the repeat was not finished, or its state is gone.
/// @throws std::invalid_argument  the file was changed, or belongs to another run.
std::optional<Run> saved_run(const SimulatePlan& plan, std::uint64_t seed);
/// None when the repeat was not begun.
/// @throws std::invalid_argument  as kept_run.
std::optional<SavedRestart> saved_restart(const SimulatePlan& plan, std::uint64_t seed);

}  // namespace repose::cli
