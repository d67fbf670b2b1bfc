#include "dem/study/study_edit.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/study/config.h"

namespace repose::dem {
namespace {

/// Offset at which a line (from 1) begins; the text's end if there is no such line.
std::size_t begin_of_line(std::string_view text, int line) {
  std::size_t at = 0;
  for (int k = 1; k < line; ++k) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos) return text.size();
    at = end + 1;
  }
  return at;
}

const ConfigValue* table_in(const ConfigValue& config, std::string_view path) {
  const ConfigValue* table = &config;
  while (table != nullptr && !path.empty()) {
    const std::size_t point = std::min(path.find('.'), path.size());
    table = table->find(std::string(path.substr(0, point)));
    path.remove_prefix(std::min(point + 1, path.size()));
  }
  return table;
}

[[noreturn]] void refuse_edit(const NumberEdit& edit, const std::string& what) {
  throw base::InputError({.subject = edit.table + '.' + edit.key,
                          .value = what,
                          .fix = "change it in the file, with a text editor."});
}

/// Offset of a key's value in an inline table on that line; npos: not found.
std::size_t inline_value_at(std::string_view text, std::size_t line, std::size_t end,
                            const std::string& key, const std::string& shown) {
  const std::string_view table = text.substr(0, end);
  for (std::size_t at = table.find('{', line); at != std::string_view::npos;
       at = table.find(key, at + 1)) {
    if (table.substr(at, key.size()) != key) continue;
    const bool is_whole = table.find_last_of("{, \t", at - 1) == at - 1;
    const std::size_t equals = table.find_first_not_of(" \t", at + key.size());
    if (!is_whole || equals == std::string_view::npos || table[equals] != '=') continue;
    const std::size_t value = table.find_first_not_of(" \t", equals + 1);
    if (value != std::string_view::npos && table.substr(value, shown.size()) == shown) return value;
  }
  return std::string::npos;
}

std::string with_number(std::string text, const NumberEdit& edit) {
  StudyErrors errors;
  const ConfigValue config = parse_config("study", text, {}, errors);
  errors.throw_if_any();
  const ConfigValue* table = table_in(config, edit.table);
  if (table == nullptr || table->kind != ConfigValue::Kind::table ||
      (table->is_inline && table->find(edit.key) == nullptr)) {
    refuse_edit(edit, fmt::format("cannot be set: there is no [{}]", edit.table));
  }
  const ConfigValue* value = table->find(edit.key);
  if (value == nullptr) {
    if (edit.number.empty()) return text;
    const std::size_t heading = begin_of_line(text, table->place.line);
    // A table of dotted keys has no heading.
    if (text.compare(heading, edit.table.size() + 2, '[' + edit.table + ']') != 0) {
      refuse_edit(edit, fmt::format("cannot be set: no line is [{}]", edit.table));
    }
    std::size_t below = text.find('\n', heading);
    if (below == std::string::npos) {
      below = text.size();
      text += '\n';
    }
    return text.insert(below + 1, fmt::format("{} = {}\n", edit.key, edit.number));
  }
  const std::size_t line = begin_of_line(text, value->place.line);
  const std::size_t end = std::min(text.find('\n', line), text.size());
  const std::size_t equals = text.find('=', line);
  const std::size_t at = table->is_inline ? inline_value_at(text, line, end, edit.key, value->shown)
                                          : text.find(value->shown, equals);
  const bool is_number =
      value->kind == ConfigValue::Kind::number || value->kind == ConfigValue::Kind::integer;
  if (!is_number || at == std::string::npos || at >= end) {
    refuse_edit(edit, fmt::format("is {}, and no number in a line of its own", value->shown));
  }
  if (edit.number.empty() && table->is_inline) refuse_edit(edit, "cannot be left out");
  if (!edit.number.empty()) return text.replace(at, value->shown.size(), edit.number);
  return text.erase(line, end + 1 - line);
}

}  // namespace

std::string with_numbers(std::string text, const std::vector<NumberEdit>& edits) {
  for (const NumberEdit& edit : edits) text = with_number(std::move(text), edit);
  return text;
}

}  // namespace repose::dem
