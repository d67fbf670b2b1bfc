#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "cli/common/terminal.h"

namespace repose::cli {

/// Thrown by a progress report to stop the work.
struct Interrupted {};

/// The results of `count` pieces of work, such as pictures or films, on some threads, with their
/// progress. Once interrupted, those that are missing are as they were made.
/// @param one  (number, report): the result of one; report(fraction) tells how far it is
template <typename Result, typename One>
std::vector<Result> batch_of(std::size_t count, int threads, const char* done_word,
                             const std::atomic<bool>& is_interrupted, const One& one) {
  std::vector<Result> results(count);
  PartsProgress progress(count, done_word);
  // The control holds for the parallel loops inside OpenCV too.
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t number) {
      const auto report = [&](double fraction) {
        if (is_interrupted) throw Interrupted{};
        progress.report(number, fraction);
      };
      try {
        report(0);
        results[number] = one(number, report);
      } catch (const Interrupted&) {
        return;
      }
    });
  });
  return results;
}

}  // namespace repose::cli
