#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "calibrate/study/study_simulator.h"

/// Where jobs are simulated: by threads of this process, or by the processes of an MPI job (`mpirun
/// -np 64 repose calibrate STUDY.toml`). Rank 0 hands out the jobs, saves the results, and also
/// works on jobs in a second thread; the other ranks only simulate. If repose was built without
/// MPI, all functions exist and the process is alone.
namespace repose::calibrate {

/// Called for each completed job, in any order, one at a time.
using JobDone = std::function<void(std::size_t job, const RunResult& result)>;

/// Simulates jobs with threads of this process, or processes on many machines. The results do not
/// depend on it.
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

  /// Returns when all are done, or soon after `is_interrupted`. Jobs are started in their order:
  /// long ones first keeps all workers busy to the end.
  /// @throws  the first exception from simulating a job or from `done`; the others are interrupted.
  virtual void run(const std::vector<Job>& jobs, const JobDone& done,
                   const std::atomic<bool>& is_interrupted) = 0;
};

/// Several threads of this process, each with its own job.
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

/// True when this program was started by an MPI launcher (mpirun, srun) as one of several
/// processes.
bool is_launched_as_rank();

/// False if repose was built without MPI.
bool has_ranks();

/// MPI for the lifetime of the object. Create one only in a launched process.
class RankSession {
 public:
  /// @throws std::runtime_error  MPI does not support use from a second thread.
  RankSession();
  /// Releases the other ranks, when called on rank 0.
  ~RankSession();
  RankSession(const RankSession&) = delete;
  RankSession& operator=(const RankSession&) = delete;
  RankSession(RankSession&&) = delete;
  RankSession& operator=(RankSession&&) = delete;

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }

  /// For ranks above 0: simulates what rank 0 sends until released.
  void serve(const StudySimulator& simulator, const std::atomic<bool>& is_interrupted) const;

 private:
  int rank_ = 0;
  int ranks_ = 1;
};

/// For rank 0.
class RankExecutor : public Executor {
 public:
  RankExecutor(const RankSession& session, const StudySimulator& simulator)
      : session_(session), simulator_(simulator) {}

  int workers() const override { return session_.ranks(); }
  void run(const std::vector<Job>& jobs, const JobDone& done,
           const std::atomic<bool>& is_interrupted) override;

 private:
  const RankSession& session_;
  const StudySimulator& simulator_;
};

/// Jobs as text, to be sent to another process. Every number is restored to the last bit.
std::string text_of(const Job& job);
Job job_in(const std::string& text);

}  // namespace repose::calibrate
