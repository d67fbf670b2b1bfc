#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dem/study/study_errors.h"

namespace repose::dem {

/// A value of a TOML file, with the place where it stands.
struct ConfigValue {
  enum class Kind { table, array, text, integer, number, boolean, time };

  std::string name;  ///< within its table; empty for items of an array
  Place place;
  Kind kind = Kind::table;
  std::string shown;  ///< as typed; of more than one line only the first
  std::string text;
  std::int64_t integer = 0;
  double number = 0;               ///< also of an integer
  bool is_inline = false;          ///< { a table like this }
  std::vector<ConfigValue> items;  ///< of a table, in the order of their names, or of an array

  /// A table's value of that name; null when there is none.
  const ConfigValue* find(const std::string& key) const;
};

/// Parses a file's text and lays the settings ("key.path=value") over it, one after the other: a
/// value replaces, "[section]" keys are added. What is no TOML becomes an error.
ConfigValue parse_config(const std::string& file, const std::string& text,
                         const std::vector<std::string>& settings, StudyErrors& errors);

}  // namespace repose::dem
