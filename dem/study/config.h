#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/input_error.h"

namespace repose::dem {

/// Where in a study something stands: in the file, or in a setting laid over it.
struct Place {
  std::string file;
  int setting = 0;  ///< 0 for the file, 1 for the first setting
  int line = 0;
  int column = 0;

  /// "study.toml:12:5", or "setting:1:5" with "setting" as a base::field().
  std::string text() const;
};

/// All that is wrong with a study, told at once.
class StudyErrors {
 public:
  /// `what` is "key = value", or "key is missing".
  void add(const Place& place, const std::string& what, const std::string& rule,
           const std::string& fix);

  /// @throws base::InputError  a line for each error, in the order of the file.
  void throw_if_any() const;

 private:
  struct Error {
    Place place;
    base::Fault fault;
  };
  std::vector<Error> errors_;
};

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
