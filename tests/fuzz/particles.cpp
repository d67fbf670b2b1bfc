#include "calibrate/particles/particles.h"

#include "calibrate/particles/standing_heap.h"
#include "tests/fuzz/scratch_file.h"

namespace repose::fuzz {

/// Of any kind: the first bytes say which. And the heap in it.
void read_particles(Bytes bytes) {
  const calibrate::Particles particles =
      calibrate::read_particles(scratch_file("particles", bytes));
  calibrate::standing_heap("particles", particles, {});
}

}  // namespace repose::fuzz
