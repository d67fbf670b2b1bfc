#include "cli/measure/measure_batch.h"

#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>

#include "cli/common/batch.h"
#include "cli/measure/measure_file.h"

namespace repose::cli {

std::vector<MeasuredPicture> measure_batch(const MeasurePlan& plan,
                                           const std::atomic<bool>& is_interrupted) {
  using Measured = std::vector<MeasuredPicture>;
  std::vector<Measured> results =
      batch_of<Measured>(plan.pictures.size(), plan.threads, "measured", is_interrupted,
                         [&](std::size_t number, const std::function<void(double)>& report) {
                           return measure_file(plan, number, report);
                         });
  Measured all;
  for (Measured& one : results) {
    std::move(one.begin(), one.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace repose::cli
