#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace repose::calibrate {

/// What a template's {{NAME}} stand for. A section {{#NAME}} ... {{/NAME}} is written once for each
/// of its fields, and not at all without.
struct DeckFields {
  std::string name;  ///< of the section that these are for; empty for the whole template
  std::vector<std::pair<std::string, std::string>> values;
  std::vector<DeckFields> sections;

  /// A text of one line: whatever would end the line becomes a blank.
  void set(const std::string& field, const std::string& value);
  /// A text of our own, as it is.
  void set_lines(const std::string& field, const std::string& text);
  /// As short as it can be to come back to the last bit.
  void set(const std::string& field, double value);
  void set(const std::string& field, int value);
  /// To be filled before the next is added.
  DeckFields& add_section(const std::string& section);
};

/// Shortest digits that come back to the last bit.
std::string number(double value);

/// A name that cannot break a deck: letters, digits, blanks and "_-.,+%" stay, bytes of letters
/// beyond ASCII too; all else, and bytes that are no UTF-8, becomes "_".
std::string sanitized(std::string_view name);

/// A template (of calibrate/export/templates, by its name there) filled in. Blank lines are left
/// out. Throws std::logic_error for a template that is wrong.
std::string filled(const std::string& template_name, const DeckFields& fields);

}  // namespace repose::calibrate
