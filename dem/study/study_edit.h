#pragma once

#include <string>
#include <vector>

/// Changes of a study file's text that leave all the rest of it, its comments too, as it is.
namespace repose::dem {

/// A number of a table: "experiment.drop", "height_mm", "500". An empty number takes the line out.
struct NumberEdit {
  std::string table;
  std::string key;
  std::string number;
};

/// The text with these numbers in it; a key that is not there yet is added below its table's
/// heading. Whether the study can be used then, read_study() says.
/// @throws base::InputError  the text is no TOML; there is no such table, or its key's value is no
///   number in a line of its own.
std::string with_numbers(std::string text, const std::vector<NumberEdit>& edits);

}  // namespace repose::dem
