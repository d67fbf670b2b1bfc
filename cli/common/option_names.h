#pragma once

#include <span>
#include <string>
#include <string_view>

namespace repose::cli {

/// A value as libraries call it in their messages, and the option that gives it.
struct OptionName {
  std::string_view value;   ///< "camera pitch"
  std::string_view option;  ///< "--pitch-deg"
};

/// The message with each option behind the first mention of its value in a line: "give the camera
/// pitch (--pitch-deg)".
std::string naming_options(std::string message, std::span<const OptionName> names);

}  // namespace repose::cli
