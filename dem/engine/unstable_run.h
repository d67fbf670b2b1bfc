#pragma once

#include <stdexcept>

namespace repose::dem {

/// A run that must not be reported as a result: what went wrong, where and when.
class UnstableRun : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace repose::dem
