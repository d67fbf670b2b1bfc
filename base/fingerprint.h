#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace repose::base {

/// A UUID of the bytes of several texts (RFC 4122, version 5: SHA-1). Depends on where one text
/// ends and the next begins.
std::string fingerprint(const std::vector<std::string>& texts);

}  // namespace repose::base
