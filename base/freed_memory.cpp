#include "base/freed_memory.h"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace repose::base {

void disable_heap_trimming() {
#ifdef __GLIBC__
  constexpr int kMiB = 1 << 20;
  ::mallopt(M_MMAP_THRESHOLD, 32 * kMiB);  // the maximum that it accepts
  ::mallopt(M_TRIM_THRESHOLD, 256 * kMiB);
#endif
}

}  // namespace repose::base
