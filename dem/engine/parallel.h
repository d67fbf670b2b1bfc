#pragma once

#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace repose::dem {

/// Calls body(index) for 0 ... count - 1; in chunks on all threads of the arena when more than one.
template <typename Body>
void for_each_index(std::size_t count, int threads, const Body& body, std::size_t chunk = 64) {
  if (threads == 1) {
    for (std::size_t k = 0; k < count; ++k) body(k);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, chunk),
                    [&body](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t k = range.begin(); k != range.end(); ++k) body(k);
                    });
}

}  // namespace repose::dem
