#pragma once

#include "calibrate/study/executor.h"

namespace repose::calibrate {

/// Several threads of this process, each with a job of its own.
class ThreadExecutor : public Executor {
 public:
  ThreadExecutor(const StudySimulator& simulator, int threads)
      : simulator_(simulator), threads_(threads) {}

  int workers() const override { return threads_; }
  void run(const std::vector<Job>& jobs, const JobDone& done,
           const std::atomic<bool>& is_interrupted) override;

 private:
  const StudySimulator& simulator_;
  int threads_;
};

}  // namespace repose::calibrate
