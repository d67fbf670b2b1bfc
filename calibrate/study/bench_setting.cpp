#include "calibrate/study/bench_setting.h"

#include <algorithm>
#include <vector>

namespace repose::calibrate {

double protocol_value(const dem::ExperimentEntry& entry, dem::Protocol protocol,
                      std::string_view key) {
  const std::vector<dem::ProtocolKey> keys = entry.keys(protocol);
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const auto& one) { return one.name == key; });
  return dem::value_of(*found).value();
}

}  // namespace repose::calibrate
