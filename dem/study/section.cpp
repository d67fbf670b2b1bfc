#include "dem/study/section.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"

namespace repose::dem {
namespace {

using Kind = ConfigValue::Kind;

std::string for_example(const std::string& example) { return "for example " + example; }

/// Text without control characters: a zero byte would truncate a file name, and another file be
/// opened.
bool is_text(const ConfigValue& value) {
  const auto is_control = [](char letter) { return letter >= 0 && letter < ' '; };
  return value.kind == Kind::text && !value.text.empty() &&
         std::none_of(value.text.begin(), value.text.end(), is_control);
}

/// A known key spelt nearly like the one typed; else one that begins the same: "density" for
/// "density_kg_m3", "height_m" for "height_mm".
std::string guess(const std::string& typed, const std::vector<std::string>& known) {
  std::string best = base::closest_word(typed, known);
  if (!best.empty()) return best;
  const std::string stem = typed.substr(0, typed.find('_'));
  for (const std::string& key : known) {
    if (key.starts_with(stem)) return key;
  }
  return {};
}

}  // namespace

Section::Section(const ConfigValue* table, std::string path, const Place& otherwise,
                 StudyErrors& errors)
    : table_(table),
      path_(std::move(path)),
      place_(table == nullptr ? otherwise : table->place),
      errors_(&errors) {
  if (table_ == nullptr || table_->kind == Kind::table) return;
  errors_->add(place_, fmt::format("{} = {}", path_, table_->shown), "a section with keys",
               fmt::format("write [{}] and its keys below it", path_));
  table_ = nullptr;
}

bool Section::has(const std::string& key) const {
  return table_ != nullptr && table_->find(key) != nullptr;
}

const ConfigValue* Section::value(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return table_ == nullptr ? nullptr : table_->find(key);
}

Section Section::section(const std::string& key) {
  return {value(key), full(key), place_, *errors_};
}

void Section::wrong(const ConfigValue& value, const std::string& rule,
                    const std::string& fix) const {
  const std::string name = value.name.empty() ? path_ : full(value.name);
  errors_->add(value.place, fmt::format("{} = {}", name, value.shown), rule, fix);
}

void Section::missing(const std::string& key, const std::string& rule,
                      const std::string& example) const {
  errors_->add(place_, full(key) + " is missing", rule,
               fmt::format("add {} to [{}]", example, path_));
}

bool Section::is_number(const ConfigValue& value, const Range& range,
                        const std::string& example) const {
  const bool has_number = value.kind == Kind::number || value.kind == Kind::integer;
  if (has_number && range.contains(value.number)) return true;
  wrong(value, range.rule(), for_example(example));
  return false;
}

std::optional<double> Section::number(const std::string& key, const Range& range,
                                      const std::string& example) {
  const ConfigValue* found = value(key);
  if (found == nullptr || !is_number(*found, range, example)) return std::nullopt;
  return found->number;
}

double Section::needed_number(const std::string& key, const Range& range,
                              const std::string& example) {
  if (exists() && !has(key)) missing(key, range.rule(), example);
  return number(key, range, example).value_or(0);
}

std::optional<std::int64_t> Section::integer(const std::string& key, std::int64_t from,
                                             std::int64_t to, const std::string& example) {
  const ConfigValue* found = value(key);
  if (found == nullptr) return std::nullopt;
  if (found->kind != Kind::integer || found->integer < from || found->integer > to) {
    wrong(*found, fmt::format("a whole number from {} to {}", from, to), for_example(example));
    return std::nullopt;
  }
  return found->integer;
}

std::optional<std::string> Section::text(const std::string& key, const std::string& example) {
  const ConfigValue* found = value(key);
  if (found == nullptr) return std::nullopt;
  if (!is_text(*found)) {
    wrong(*found, "text in quotes, without control characters", for_example(example));
    return std::nullopt;
  }
  return found->text;
}

std::optional<bool> Section::truth(const std::string& key, const std::string& example) {
  const ConfigValue* found = value(key);
  if (found == nullptr) return std::nullopt;
  if (found->kind != Kind::boolean) {
    wrong(*found, "true or false", for_example(example));
    return std::nullopt;
  }
  return found->shown == "true";
}

std::optional<std::vector<double>> Section::numbers(const std::string& key, const Range& range,
                                                    const std::string& example) {
  const ConfigValue* found = value(key);
  if (found == nullptr) return std::nullopt;
  if (found->kind != Kind::array || found->items.empty()) {
    wrong(*found, "numbers in brackets", for_example(example));
    return std::nullopt;
  }
  std::vector<double> result;
  for (ConfigValue item : found->items) {
    item.name = key;
    if (is_number(item, range, example)) result.push_back(item.number);
  }
  if (result.size() != found->items.size()) return std::nullopt;
  return result;
}

std::optional<std::vector<std::string>> Section::texts(const std::string& key,
                                                       const std::string& example) {
  const ConfigValue* found = value(key);
  if (found == nullptr) return std::nullopt;
  std::vector<std::string> result;
  for (const ConfigValue& item : found->items) {
    if (is_text(item)) result.push_back(item.text);
  }
  if (found->kind != Kind::array || result.empty() || result.size() != found->items.size()) {
    wrong(*found, "texts in quotes without control characters, within brackets",
          for_example(example));
    return std::nullopt;
  }
  return result;
}

void Section::reject_unknown_keys() const {
  if (table_ == nullptr) return;
  for (const ConfigValue& item : table_->items) {
    if (std::find(known_.begin(), known_.end(), item.name) != known_.end()) continue;
    const std::string best = guess(item.name, known_);
    const std::string what =
        fmt::format("{} = {}: there is no such key", full(item.name), item.shown);
    const std::string where = path_.empty() ? "a study" : fmt::format("[{}]", path_);
    errors_->add(
        item.place, best.empty() ? what : fmt::format("{} (did you mean {}?)", what, best),
        fmt::format("keys of {} are {}", where, fmt::join(known_, ", ")),
        best.empty() ? "correct the name or take the line out" : fmt::format("write {}", best));
  }
}

}  // namespace repose::dem
