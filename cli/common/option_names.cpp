#include "cli/common/option_names.h"

#include <cctype>

#include <fmt/format.h>

namespace repose::cli {

namespace {

/// As whole words: "budget" is not mentioned in "budget_s".
std::size_t first_mention(const std::string& message, std::string_view value, std::size_t from) {
  const auto goes_on = [&message](std::size_t end) {
    return end < message.size() &&
           (message[end] == '_' || std::isalnum(static_cast<unsigned char>(message[end])) != 0);
  };
  std::size_t at = message.find(value, from);
  while (at != std::string::npos && goes_on(at + value.size())) at = message.find(value, at + 1);
  return at;
}

}  // namespace

std::string naming_options(std::string message, std::span<const OptionName> names) {
  for (const auto& [value, option] : names) {
    for (std::size_t at = first_mention(message, value, 0); at != std::string::npos;) {
      message.insert(at + value.size(), fmt::format(" ({})", option));
      const std::size_t line_end = message.find('\n', at);
      at = line_end == std::string::npos ? line_end : first_mention(message, value, line_end);
    }
  }
  return message;
}

}  // namespace repose::cli
