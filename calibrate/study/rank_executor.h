#pragma once

#include "calibrate/study/executor.h"

/// Jobs farmed out over the processes of an MPI job: `mpirun -np 64 repose calibrate STUDY.toml`.
///
/// Rank 0 hands the jobs out, keeps what comes back, and works on jobs itself in a second thread;
/// the other ranks only simulate. Absent where repose was built without MPI: all functions are
/// there, and the process is alone.
namespace repose::calibrate {

/// True when this program was started by an MPI launcher (mpirun, srun) as one of several
/// processes.
bool is_launched_as_rank();

/// False where repose was built without MPI.
bool has_ranks();

/// MPI from here to the end of the object. Make one only in a launched process.
class RankSession {
 public:
  /// @throws std::runtime_error  MPI cannot be used by a thread beside another one.
  RankSession();
  /// Lets the other ranks go, when called on rank 0.
  ~RankSession();
  RankSession(const RankSession&) = delete;
  RankSession& operator=(const RankSession&) = delete;
  RankSession(RankSession&&) = delete;
  RankSession& operator=(RankSession&&) = delete;

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }

  /// For ranks above 0: simulates what rank 0 sends until it lets go.
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

}  // namespace repose::calibrate
