#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/input_error.h"

namespace repose::dem {

/// A place in a study: in the file, or in a setting that overrides it.
struct Place {
  std::string file;
  int setting = 0;  ///< 0 for the file, 1 for the first setting
  int line = 0;
  int column = 0;

  /// "study.toml:12:5", or "setting:1:5" with "setting" as a base::field().
  std::string text() const;
};

/// Collects all errors of a study, to report them together.
class StudyErrors {
 public:
  /// `what` is "key = value", or "key is missing".
  void add(const Place& place, const std::string& what, const std::string& rule,
           const std::string& fix);

  /// @throws base::InputError  one line per error, in file order.
  void throw_if_any() const;

 private:
  struct Error {
    Place place;
    base::Fault fault;
  };
  std::vector<Error> errors_;
};

/// A value of a TOML file, with its place.
struct ConfigValue {
  enum class Kind { table, array, text, integer, number, boolean, time };

  std::string name;  ///< within its table; empty for items of an array
  Place place;
  Kind kind = Kind::table;
  std::string shown;  ///< as typed; only the first line
  std::string text;
  std::int64_t integer = 0;
  double number = 0;               ///< also set for an integer
  bool is_inline = false;          ///< { a table like this }
  std::vector<ConfigValue> items;  ///< of a table, sorted by name, or of an array

  /// A table's value of that name; null if there is none.
  const ConfigValue* find(const std::string& key) const;
};

/// Parses a file's text and applies the settings ("key.path=value") in order: values are replaced,
/// the keys of a section are merged. Invalid TOML becomes an error.
ConfigValue parse_config(const std::string& file, const std::string& text,
                         const std::vector<std::string>& settings, StudyErrors& errors);

}  // namespace repose::dem
