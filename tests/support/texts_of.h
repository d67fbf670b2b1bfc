#pragma once

#include <string>
#include <vector>

#include "base/input_error.h"

namespace repose {

/// The text of each fault.
inline std::vector<std::string> texts_of(const std::vector<base::Fault>& faults) {
  std::vector<std::string> texts;
  for (const base::Fault& fault : faults) texts.push_back(fault.text());
  return texts;
}

}  // namespace repose
