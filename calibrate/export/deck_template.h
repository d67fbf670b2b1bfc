#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace repose::calibrate {

/// Values for a template's {{NAME}} fields. A section {{#NAME}} to {{/NAME}} is written once for
/// each DeckFields of that name, and omitted if there is none.
struct DeckFields {
  std::string name;  ///< of the section; empty for the whole template
  std::vector<std::pair<std::string, std::string>> values;
  std::vector<DeckFields> sections;

  /// A one-line text: line breaks become blanks.
  void set(const std::string& field, const std::string& value);
  /// A text of our own, unchanged.
  void set_lines(const std::string& field, const std::string& text);
  /// Shortest digits that restore the value to the last bit.
  void set(const std::string& field, double value);
  void set(const std::string& field, int value);
  /// Must be filled before the next section is added.
  DeckFields& add_section(const std::string& section);
};

/// Shortest digits that restore the value to the last bit.
std::string number(double value);

/// A name that cannot break a deck: letters, digits, blanks and "_-.,+%" stay, bytes of letters
/// beyond ASCII too; everything else, including invalid UTF-8, becomes "_".
std::string sanitized(std::string_view name);

/// Fills in a template (by its name in calibrate/export/templates). Blank lines are removed. Throws
/// std::logic_error for an invalid template.
std::string filled(const std::string& template_name, const DeckFields& fields);

}  // namespace repose::calibrate
