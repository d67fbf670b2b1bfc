#include "calibrate/study/thread_executor.h"

#include <algorithm>
#include <mutex>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace repose::calibrate {

void ThreadExecutor::run(const std::vector<Job>& jobs, const JobDone& done,
                         const std::atomic<bool>& is_interrupted) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> is_broken_off{false};
  std::mutex telling;
  const auto work = [&] {
    for (std::size_t k = next++; k < jobs.size() && !is_interrupted && !is_broken_off; k = next++) {
      const RunResult result = simulator_.simulate(jobs[k], is_interrupted);
      const std::scoped_lock lock(telling);
      done(k, result);
    }
  };
  const auto guarded = [&](int) {
    try {
      work();
    } catch (const dem::Interrupted&) {
      return;
    } catch (...) {
      is_broken_off = true;
      throw;
    }
  };
  const int workers = std::min(threads_, static_cast<int>(jobs.size()));
  tbb::task_arena arena(std::max(1, workers));
  // One task a worker, each taking jobs in their order.
  arena.execute([&] { tbb::parallel_for(0, workers, 1, guarded, tbb::simple_partitioner()); });
}

}  // namespace repose::calibrate
