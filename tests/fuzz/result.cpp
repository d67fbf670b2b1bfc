#include "calibrate/result/result.h"

#include "tests/fuzz/scratch_file.h"

namespace repose::fuzz {

/// And writes what it read.
void read_result(Bytes bytes) {
  calibrate::to_json(calibrate::result_from_json(text_of(bytes), "result.json"));
}

}  // namespace repose::fuzz
