#pragma once

#include <string>

#include "base/input_error.h"

namespace repose {

/// The message of the error that a call throws; empty if it throws none.
template <typename Error = base::InputError, typename Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace repose
