#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "calibrate/bench/batch.h"
#include "cli/common/terminal.h"

namespace repose::cli {

/// Thrown by a progress report to stop the work.
struct Interrupted {};

/// Processes `count` items, such as pictures or films, on `threads` threads, with progress. After
/// an interruption, missing results are default-constructed.
/// @param one  called as (number, report), returns the result of one item; report(fraction) reports
///   its progress
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
