#include "cli/measure/measure_batch.h"

#include <cstddef>
#include <iterator>
#include <utility>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "cli/common/progress.h"
#include "cli/measure/measure_file.h"

namespace repose::cli {

std::vector<MeasuredPicture> measure_batch(const MeasurePlan& plan,
                                           const std::atomic<bool>& is_interrupted) {
  std::vector<std::vector<MeasuredPicture>> results(plan.pictures.size());
  PartsProgress progress(results.size(), "measured");
  // The control holds for the parallel loops inside OpenCV too.
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(plan.threads));
  tbb::task_arena arena(plan.threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t index) {
      const auto report = [&](double fraction) {
        if (is_interrupted) throw Interrupted{};
        progress.report(index, fraction);
      };
      try {
        report(0);
        results[index] = measure_file(plan, index, report);
      } catch (const Interrupted&) {
        return;
      }
    });
  });
  std::vector<MeasuredPicture> all;
  for (std::vector<MeasuredPicture>& one : results) {
    std::move(one.begin(), one.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace repose::cli
