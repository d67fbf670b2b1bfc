#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "base/input_error.h"

namespace repose::vision {

/// Reads the values of one hint file; what is wrong with them is collected.
class HintReader {
 public:
  HintReader(const toml::table& table, const std::filesystem::path& file)
      : table_(table), file_(file) {}

  template <std::size_t kCount>
  std::optional<std::array<double, kCount>> numbers(const char* key, const char* meaning) {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    return numbers_of<kCount>(*node, key, meaning);
  }

  /// A list of such groups.
  template <std::size_t kCount>
  std::vector<std::array<double, kCount>> groups(const char* key, const char* meaning) {
    std::vector<std::array<double, kCount>> all;
    const toml::node* node = table_.get(key);
    if (node == nullptr) return all;
    if (!node->is_array()) {
      add(*node, key, "", fmt::format("must be a list of {}", meaning));
      return all;
    }
    for (const toml::node& item : *node->as_array()) {
      if (const auto group = numbers_of<kCount>(item, key, meaning)) all.push_back(*group);
    }
    return all;
  }

  std::optional<double> number(const char* key);
  /// A number above 0.
  std::optional<double> positive(const char* key);
  std::optional<bool> truth(const char* key);
  std::string file_name(const char* key);

  void refuse_other_keys(std::initializer_list<std::string_view> known);
  /// What the value of a key, which is there, must not be beside others.
  void refuse(const char* key, const std::string& value, const std::string& rule);
  void throw_if_any() const { errors_.throw_if_any(); }

 private:
  static constexpr double kLargestPixel = 1e6;

  void add(const toml::node& node, const std::string& key, const std::string& value,
           const std::string& rule);

  template <std::size_t kCount>
  std::optional<std::array<double, kCount>> numbers_of(const toml::node& node, const char* key,
                                                       const char* meaning) {
    std::array<double, kCount> values{};
    const toml::array* list = node.as_array();
    bool is_good = list != nullptr && list->size() == kCount;
    for (std::size_t i = 0; is_good && i < kCount; ++i) {
      const auto value = list->get(i)->value<double>();
      is_good = value && std::abs(*value) <= kLargestPixel;  // NaN fails
      values[i] = value.value_or(0);
    }
    if (is_good) return values;
    add(node, key, "", fmt::format("must be {}", meaning));
    return std::nullopt;
  }

  const toml::table& table_;
  const std::filesystem::path& file_;
  base::Faults errors_;
};

/// The text of a hint file.
/// @throws base::InputError  it is no TOML.
toml::table parse_hints(const std::string& text, const std::filesystem::path& file);

}  // namespace repose::vision
