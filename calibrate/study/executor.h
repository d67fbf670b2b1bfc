#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "calibrate/study/study_simulator.h"

namespace repose::calibrate {

/// Hears of each job that is done, in any order, one at a time.
using JobDone = std::function<void(std::size_t job, const RunResult& result)>;

/// Something that simulates jobs: threads of this process, or processes on many machines. What the
/// jobs give does not depend on it.
class Executor {
 public:
  Executor() = default;
  virtual ~Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  Executor(Executor&&) = delete;
  Executor& operator=(Executor&&) = delete;

  /// How many jobs it works on at once.
  virtual int workers() const = 0;

  /// Returns when all are done, or soon after `is_interrupted`. Jobs are begun in their order: long
  /// ones first keeps all workers busy to the end.
  /// @throws  what simulating a job or hearing of it threw first; the others are interrupted.
  virtual void run(const std::vector<Job>& jobs, const JobDone& done,
                   const std::atomic<bool>& is_interrupted) = 0;
};

}  // namespace repose::calibrate
