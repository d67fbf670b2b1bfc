#include "tests/bench/drawn_subjects.h"

#include "tests/support/heap_picture.h"

namespace repose::bench {
namespace {

KnownPicture taken(const testing::Condition& condition, std::uint64_t seed) {
  testing::DrawnHeap heap = testing::draw_heap(condition.scene(seed));
  return {.picture = std::move(heap.picture),
          .heap = {.left_rad = heap.left_rad, .right_rad = heap.right_rad}};
}

}  // namespace

std::vector<Subject> drawn_subjects(int seeds, std::uint64_t first_seed) {
  std::vector<Subject> subjects;
  for (const testing::Condition& condition : testing::conditions()) {
    for (int i = 0; i < seeds; ++i) {
      const std::uint64_t seed = first_seed + static_cast<unsigned>(i);
      subjects.push_back({.section = "drawn",
                          .condition = condition.name,
                          .group = condition.group,
                          .seed = seed,
                          .take = [&condition, seed] { return taken(condition, seed); }});
    }
  }
  return subjects;
}

}  // namespace repose::bench
