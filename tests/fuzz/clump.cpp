#include "dem/shape/clump/clump_file.h"
#include "tests/fuzz/scratch_file.h"

namespace repose::fuzz {

void read_clump(Bytes bytes) { dem::read_clump_file(scratch_file("clump.json", bytes)); }

}  // namespace repose::fuzz
