#pragma once

#include <string>
#include <vector>

namespace repose::dem {

/// Where in a study something stands: in the file, or in a setting laid over it.
struct Place {
  std::string file;
  int setting = 0;  ///< 0 for the file, 1 for the first setting
  int line = 0;
  int column = 0;

  std::string text() const;  ///< "study.toml:12:5" or "setting:1:5"
};

/// All that is wrong with a study, told at once.
class StudyErrors {
 public:
  /// `what` is "key = value", or "key is missing".
  void add(const Place& place, const std::string& what, const std::string& rule,
           const std::string& fix);

  /// @throws std::invalid_argument  a line for each error, in the order of the file.
  void throw_if_any() const;

 private:
  struct Error {
    Place place;
    std::string text;
  };
  std::vector<Error> errors_;
};

}  // namespace repose::dem
