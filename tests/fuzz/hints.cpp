#include "tests/fuzz/scratch_file.h"
#include "vision/hints/hint_file.h"

namespace repose::fuzz {

void read_hints(Bytes bytes) {
  const auto file = scratch_file("heap.png.repose.toml", bytes);
  vision::with_saved_hints({}, file.parent_path() / "heap.png");
}

}  // namespace repose::fuzz
