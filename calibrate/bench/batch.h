#pragma once

#include <cstddef>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace repose::calibrate {

/// The results of `count` pieces of work, such as pictures or films, on some threads.
/// @param one  (number): the result of one; what it throws ends the work
template <typename Result, typename One>
std::vector<Result> batch_of(std::size_t count, int threads, const One& one) {
  std::vector<Result> results(count);
  // The control holds for the parallel loops inside OpenCV too.
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
