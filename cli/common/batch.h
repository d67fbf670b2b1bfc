#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "calibrate/bench/batch.h"
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
  PartsProgress progress(count, done_word);
  return calibrate::batch_of<Result>(count, threads, [&](std::size_t number) {
    const auto report = [&](double fraction) {
      if (is_interrupted) throw Interrupted{};
      progress.report(number, fraction);
    };
    try {
      report(0);
      return one(number, report);
    } catch (const Interrupted&) {
      return Result{};
    }
  });
}

}  // namespace repose::cli
