#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace repose::dem {

/// Calls body(index) for 0 ... count - 1; in chunks on all threads of the arena if `threads` is
/// above 1.
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

/// Number of chunks of up to `length` needed for `size`.
inline std::size_t chunks_of(std::size_t size, std::size_t length) {
  return (size + length - 1) / length;
}

/// A range of indices that one thread works on.
struct Chunk {
  std::size_t number = 0;
  std::size_t first = 0;
  std::size_t end = 0;

  std::size_t size() const { return end - first; }
};

/// Bodies, or pairs of them, per chunk when neighbours are listed.
inline constexpr std::size_t kLookedAtTogether = 256;

/// Likewise calls body(chunk) for chunks of up to `length` of 0 ... size - 1.
template <typename Body>
void for_each_chunk(std::size_t size, std::size_t length, int threads, const Body& body) {
  for_each_index(
      chunks_of(size, length), threads,
      [&](std::size_t k) {
        body(Chunk{.number = k, .first = k * length, .end = std::min(size, (k + 1) * length)});
      },
      1);
}

/// Sorts items whose order is unique (no two are equivalent).
template <typename Item, typename Before>
void sort_all(std::vector<Item>& items, int threads, const Before& before) {
  if (threads == 1) {
    std::sort(items.begin(), items.end(), before);
  } else {
    tbb::parallel_sort(items.begin(), items.end(), before);
  }
}

}  // namespace repose::dem
