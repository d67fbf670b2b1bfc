#include "vision/picture/picture.h"

#include "tests/fuzz/scratch_file.h"

namespace repose::fuzz {

void read_picture(Bytes bytes) { vision::read_picture(scratch_file("picture", bytes)); }

}  // namespace repose::fuzz
