#include "calibrate/experiment/run_store.h"
#include "tests/fuzz/scratch_file.h"

namespace repose::fuzz {

void read_restart(Bytes bytes) { calibrate::restart_in(text_of(bytes), "{}"); }

}  // namespace repose::fuzz
