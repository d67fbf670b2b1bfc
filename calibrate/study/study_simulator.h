#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/experiment/simulate_experiment.h"
#include "calibrate/fit/problem.h"
#include "dem/experiment/experiment.h"
#include "dem/shape/clump/clump_file.h"
#include "dem/study/study.h"

namespace repose::calibrate {

/// A coefficient of a study by its name in the file.
struct NamedCoefficient {
  std::string name;  ///< "contact.particle_wall.restitution"
  dem::Coefficient coefficient;
};

/// The six of plate and grains, walls first, and those of each part of another material.
std::vector<NamedCoefficient> coefficients_of(const dem::Study& study);

/// Where a bench has it; null where it does not.
double* find_coefficient(const std::string& name, dem::Model& model);
/// Likewise. Throws base::InputError for a name that there is not.
double& coefficient_named(const std::string& name, dem::Model& model);

/// What a fit takes from a job's result: its readings (see readings_of), or why there are none.
Run run_of(const Job& job, const RunResult& result);

/// Turns jobs into runs: the study's experiments with a job's coefficients.
class StudySimulator {
 public:
  /// @param sought  what a job's values are, in their order
  /// @param heap_views  pictures of each heap; 0: none are taken
  StudySimulator(dem::Study study, dem::ClumpFile grain, const std::vector<Parameter>& sought,
                 int heap_views = kHeapViews);

  /// What a job asks for but its seed.
  /// @throws base::InputError  its grain cannot be made (see finer_grain).
  RunSpec spec(const Job& job) const;

  /// The study's grain of so many times its spheres, made when it is first asked for, which may
  /// take some seconds; may be called from several threads.
  /// @throws base::InputError  so many spheres do not follow the surface, or there is none.
  const dem::ClumpFile& finer_grain(double multiple) const;

  /// Where runs are found and saved, with the final states of heaps; to be there as long as this.
  void store_in(const RunStore& folder) { folder_ = &folder; }

  /// Which program makes the runs; ours unless told otherwise.
  void use(std::shared_ptr<const Simulator> simulator) { simulator_ = std::move(simulator); }

  /// Runs it on one thread; may be called from several. An experiment in which nothing can be read,
  /// or that becomes unstable, is a run with a failure.
  /// @throws dem::Interrupted  `is_interrupted` became true.
  /// @throws base::InputError  as simulate_experiment.
  /// @throws std::runtime_error  this machine cannot draw: heaps without pictures must not be
  /// fitted together with those that have them.
  RunResult simulate(const Job& job, const std::atomic<bool>& is_interrupted) const;

 private:
  struct FinerGrains;
  int spheres(double multiple) const;
  const NamedGrain& grain(const dem::GrainSource& source, const AssumedInputs& inputs) const;

  dem::Study study_;
  dem::ClumpFile study_grain_;
  NamedGrain grain_;
  std::shared_ptr<FinerGrains> finer_;
  std::vector<std::string> names_;
  int heap_views_;
  const RunStore* folder_ = nullptr;
  std::shared_ptr<const Simulator> simulator_ = own_simulator();
};

}  // namespace repose::calibrate
