#pragma once

#include <span>
#include <string>
#include <string_view>

/// Tables of comma-separated values (RFC 4180), except that lines end in LF.
namespace repose::base {

/// Quoted if necessary. Text that a spreadsheet would interpret as a formula gets a leading "'".
std::string csv_cell(std::string_view text);

/// The cells separated by commas, with the line end.
std::string csv_row(std::span<const std::string> cells);

}  // namespace repose::base
