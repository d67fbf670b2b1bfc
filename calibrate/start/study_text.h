#pragma once

#include <string>
#include <string_view>

/// Parts of a study file, written as people would.

namespace repose::calibrate {

/// The text as lines that begin with "# ".
std::string toml_comment(const std::string& text);

/// 1e8, not 1e+08.
std::string toml_number(double value);

/// The text in quotation marks.
std::string toml_text(std::string_view text);

}  // namespace repose::calibrate
