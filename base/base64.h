#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Base64 (RFC 4648), the encoding of binary arrays in VTK's XML files.
namespace repose::base {

std::string base64_of(std::span<const std::byte> bytes);

/// Blanks and line breaks at either end are skipped. std::nullopt if the rest is not base64.
std::optional<std::vector<std::byte>> bytes_of_base64(std::string_view text);

}  // namespace repose::base
