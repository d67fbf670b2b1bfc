#include "calibrate/experiment/run_store.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "tests/fuzz/scratch_file.h"

namespace repose::fuzz {

void read_restart(Bytes bytes) {
  calibrate::restart_in(text_of(bytes), "{}", dem::experiment_of<dem::HeapProtocol>()->stages);
}

}  // namespace repose::fuzz
