#include <stdexcept>

#include "calibrate/study/executor.h"

/// Replaces rank_executor.cpp if MPI was not found.
namespace repose::calibrate {

bool has_ranks() { return false; }

RankSession::RankSession() {
  throw std::runtime_error("repose was built without MPI. Fix: start it without mpirun.");
}
RankSession::~RankSession() {}  // not defaulted in the class: elsewhere it ends MPI

void RankSession::serve(const StudySimulator&, const std::atomic<bool>&) const {}

void RankExecutor::run(const std::vector<Job>&, const JobDone&, const std::atomic<bool>&) {}

}  // namespace repose::calibrate
