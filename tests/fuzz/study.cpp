#include "dem/study/study.h"

#include "tests/fuzz/scratch_file.h"

namespace repose::fuzz {

void read_study(Bytes bytes) { dem::read_study(scratch_file("study.toml", bytes)); }

}  // namespace repose::fuzz
