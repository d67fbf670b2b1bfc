#include "base/base64.h"

#include <algorithm>

#include <boost/beast/core/detail/base64.hpp>

namespace repose::base {
namespace {

namespace base64 = boost::beast::detail::base64;

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

}  // namespace

std::string base64_of(std::span<const std::byte> bytes) {
  std::string text(base64::encoded_size(bytes.size()), '=');
  text.resize(base64::encode(text.data(), bytes.data(), bytes.size()));
  return text;
}

std::optional<std::vector<std::byte>> bytes_of_base64(std::string_view text) {
  text = without_blanks(text);
  if (text.size() % 4 != 0) return std::nullopt;
  const std::size_t padding = text.size() - std::min(text.size(), text.find_last_not_of('=') + 1);
  if (padding > 2) return std::nullopt;
  std::vector<std::byte> bytes(base64::decoded_size(text.size()));
  const auto [written, read] = base64::decode(bytes.data(), text.data(), text.size());
  // The library stops at the first character outside the alphabet.
  if (written != bytes.size() - padding) return std::nullopt;
  bytes.resize(written);
  return bytes;
}

}  // namespace repose::base
