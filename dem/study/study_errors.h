#pragma once

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

}  // namespace repose::dem
