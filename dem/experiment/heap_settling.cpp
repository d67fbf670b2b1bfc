#include "dem/experiment/heap_settling.h"

#include "dem/experiment/rest_test.h"

namespace repose::dem {
namespace {

/// For heaps that creep: with the lift, about the 8 s that a bench heap is given before its picture
/// is taken. In the tube it is enough too: the tube holds what creeps.
constexpr double kLongestSettling_s = 5;

}  // namespace

void begin_settling(Course& course, HeapStage stage) {
  HeapProgress& progress = course.progress();
  progress.stage = stage;
  progress.rest = {};
  progress.until_s = course.simulation().time_s() + kLongestSettling_s;
}

bool settle(Course& course, double share) {
  HeapProgress& progress = course.progress();
  RestTest rest(course.simulation().setup(), progress.rest);
  const std::int64_t steps = course.steps_of(rest.interval_s());
  while (!rest.is_at_rest(course.simulation())) {
    if (course.simulation().time_s() > progress.until_s) return false;
    progress.rest = rest.memory();
    course.advance(steps);
    course.tell(share);
  }
  return true;
}

}  // namespace repose::dem
