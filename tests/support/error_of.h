#pragma once

#include <stdexcept>
#include <string>

namespace repose {

/// The message of the error that a call throws; empty when it throws none.
template <typename Error = std::invalid_argument, typename Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace repose
