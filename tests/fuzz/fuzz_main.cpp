// What libFuzzer calls, for the one reader that REPOSE_READER names.

#include <cstddef>

#include "base/input_error.h"
#include "tests/fuzz/readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    repose::fuzz::REPOSE_READER({data, size});
  } catch (const repose::base::InputError&) {
    return 0;  // refused, as it should be
  }
  return 0;
}
