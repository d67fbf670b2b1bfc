#include "dem/shape/scan/scan.h"

#include <array>

#include "tests/fuzz/scratch_file.h"

namespace repose::fuzz {

void read_scan(Bytes bytes) {
  constexpr std::array kNames = {"scan.stl", "scan.obj", "scan.ply"};
  if (bytes.empty()) return;
  const char* name = kNames.at(bytes.front() % kNames.size());
  dem::read_scan(scratch_file(name, bytes.subspan(1)), dem::ScanUnit::millimetre);
}

}  // namespace repose::fuzz
