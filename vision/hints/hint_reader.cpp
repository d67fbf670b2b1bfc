#include "vision/hints/hint_reader.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "base/toml_nesting.h"

namespace repose::vision {

namespace fs = std::filesystem;

std::optional<double> HintReader::number(const char* key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->value<double>();
  if (!value || !std::isfinite(*value)) add(*node, key, "", "must be a number");
  return value;
}

std::optional<double> HintReader::positive(const char* key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->value<double>();
  if (value && *value > 0 && *value <= kLargestPixel) return value;  // NaN fails
  add(*node, key, "", "must be a number above 0");
  return std::nullopt;
}

std::optional<bool> HintReader::truth(const char* key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->value<bool>();
  if (!value) add(*node, key, "", "must be true or false");
  return value;
}

std::string HintReader::file_name(const char* key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return {};
  const auto value = node->value<std::string>();
  if (!value) add(*node, key, "", "must be a file's name in quotes");
  return value.value_or("");
}

void HintReader::refuse_other_keys(std::initializer_list<std::string_view> known) {
  for (const auto& [key, node] : table_) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    add(node, std::string(key.str()),
        fmt::format("is not a hint. Known hints: {}", fmt::join(known, ", ")), "");
  }
}

void HintReader::refuse(const char* key, const std::string& value, const std::string& rule) {
  if (const toml::node* node = table_.get(key)) add(*node, key, value, rule);
}

void HintReader::add(const toml::node& node, const std::string& key, const std::string& value,
                     const std::string& rule) {
  errors_.add({.where = fmt::format("{}:{}: {}", file_.string(), node.source().begin.line, key),
               .value = value,
               .rule = rule,
               .fix = "correct it, or delete the line."});
}

toml::table parse_hints(const std::string& text, const fs::path& file) {
  if (const auto line = base::line_of_deep_key(text)) {
    throw base::InputError(
        {.where = fmt::format("{}:{}", file.string(), *line),
         .value = fmt::format("a key has more than {} points", base::kMostPointsInAKey),
         .fix = "correct this line, or delete the file."});
  }
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw base::InputError({.where = fmt::format("{}:{}", file.string(), error.source().begin.line),
                            .value = fmt::format("{}", error.description()),
                            .rule = "the text must be TOML (https://toml.io)",
                            .fix = "correct this line, or delete the file."});
  }
}

}  // namespace repose::vision
