#include <array>

#include "tests/fuzz/scratch_file.h"
#include "vision/scan/scan_file.h"
#include "vision/scan/scanned_heap.h"

namespace repose::fuzz {

void read_heap_scan(Bytes bytes) {
  constexpr std::array kNames = {"heap.stl", "heap.obj", "heap.ply", "heap.glb"};
  if (bytes.empty()) return;
  const char* name = kNames.at(bytes.front() % kNames.size());
  vision::measure_scan(vision::read_scan(scratch_file(name, bytes.subspan(1))));
}

}  // namespace repose::fuzz
