#pragma once

#include <cstddef>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace repose::calibrate {

/// Processes `count` items, such as pictures or films, on `threads` threads and returns their
/// results.
/// @param one  called with an item's number, returns its result; an exception from it ends the work
template <typename Result, typename One>
std::vector<Result> batch_of(std::size_t count, int threads, const One& one) {
  std::vector<Result> results(count);
  // The control also applies to the parallel loops inside OpenCV.
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, count,
                      [&](std::size_t number) { results[number] = one(number); });
  });
  return results;
}

}  // namespace repose::calibrate
