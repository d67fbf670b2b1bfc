#include "cli/help/value_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <string_view>

namespace repose::cli {
namespace {

// Value names of files and folders contain one of them.
constexpr std::array<std::string_view, 9> kOfFiles = {
    "FILE", "FOLDER", "PICTURE", "STUDY", "READINGS", "SCAN", "STATE", "TABLE", "VIDEO"};

bool is_word(const std::string& part) {
  return !part.empty() && std::all_of(part.begin(), part.end(), [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '-';
  }) && std::islower(static_cast<unsigned char>(part.front())) != 0;
}

}  // namespace

ValueKind value_kind(const CommandOption& option) {
  ValueKind kind{.words = option.words};
  std::istringstream parts(option.value_name);
  for (std::string part; std::getline(parts, part, '|');) {
    if (is_word(part)) kind.words.push_back(part);
  }
  kind.is_file = std::any_of(kOfFiles.begin(), kOfFiles.end(), [&](std::string_view name) {
    return option.value_name.find(name) != std::string::npos;
  });
  return kind;
}

}  // namespace repose::cli
