#pragma once

#include <string>
#include <vector>

/// Edits a study file's text, leaving everything else unchanged, including comments.
namespace repose::dem {

/// A number of a table: "experiment.drop", "height_mm", "500". An empty number removes the line.
struct NumberEdit {
  std::string table;
  std::string key;
  std::string number;
};

/// The text with these numbers set; a missing key is added below its table's heading. Does not
/// check the resulting study: see read_study().
/// @throws base::InputError  the text is not TOML, there is no such table, or the key's value is
/// not a number on a line of its own.
std::string with_numbers(std::string text, const std::vector<NumberEdit>& edits);

}  // namespace repose::dem
