#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Bytes as text, as RFC 4648 has it: what binary arrays of VTK's XML files are written in.
namespace repose::base {

std::string base64_of(std::span<const std::byte> bytes);

/// Blanks and line breaks at either end are skipped. None when the rest is no base64.
std::optional<std::vector<std::byte>> bytes_of_base64(std::string_view text);

}  // namespace repose::base
