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

/// The six of plate and grains, walls first, and those of each part made of another material.
std::vector<NamedCoefficient> coefficients_of(const dem::Study& study);

/// The coefficient in a model; null if the model does not have it.
double* find_coefficient(const std::string& name, dem::Model& model);
/// Likewise. Throws base::InputError for an unknown name.
double& coefficient_named(const std::string& name, dem::Model& model);

/// The run used in a fit: a result's readings (see readings_of), or why there are none.
Run run_of(const Job& job, const RunResult& result);

/// Turns jobs into runs: the study's experiments with a job's coefficients.
class StudySimulator {
 public:
  /// @param sought  meaning of a job's values, in order
  /// @param heap_views  pictures of each heap; 0: none
  StudySimulator(dem::Study study, dem::ClumpFile grain, const std::vector<Parameter>& sought,
                 int heap_views = kHeapViews);

  /// Everything that a job specifies except its seed.
  /// @throws base::InputError  its grain cannot be made (see finer_grain).
  RunSpec spec(const Job& job) const;

  /// The study's grain with `multiple` times its spheres, made on first use, which may take some
  /// seconds; may be called from several threads.
  /// @throws base::InputError  that many spheres do not follow the surface, or there is no surface.
  const dem::ClumpFile& finer_grain(double multiple) const;

  /// Where runs are found and saved, with the final states of heaps; must outlive this.
  void store_in(const RunStore& folder) { folder_ = &folder; }

  /// Sets the program that makes the runs; by default ours.
  void use(std::shared_ptr<const Simulator> simulator) { simulator_ = std::move(simulator); }

  /// Runs it on one thread; may be called from several. An experiment in which nothing can be read,
  /// or that becomes unstable, is a run with a failure.
  /// @throws dem::Interrupted  `is_interrupted` became true.
  /// @throws base::InputError  as simulate_experiment.
  /// @throws std::runtime_error  this machine cannot render: heaps without pictures must not be
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
