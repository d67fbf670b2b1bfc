#include "tests/fuzz/scratch_file.h"
#include "vision/camera/lens_file.h"

namespace repose::fuzz {

void read_camera(Bytes bytes) {
  const auto file = scratch_file("camera.toml", bytes);
  vision::read_lens_file(file);
}

}  // namespace repose::fuzz
