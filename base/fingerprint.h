#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace repose::base {

/// A UUID made from the bytes of several texts (RFC 4122, version 5: SHA-1). Where one text ends
/// and the next begins counts.
std::string fingerprint(const std::vector<std::string>& texts);

}  // namespace repose::base
