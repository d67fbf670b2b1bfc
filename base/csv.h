#pragma once

#include <span>
#include <string>
#include <string_view>

/// Tables of comma-separated values, as RFC 4180 has them but for line ends, which are LF.
namespace repose::base {

/// Quoted when it must be. What a spreadsheet would take for a formula gets a "'" before it, by
/// which it is text.
std::string csv_cell(std::string_view text);

/// The cells with commas between them and the end of the line.
std::string csv_row(std::span<const std::string> cells);

}  // namespace repose::base
