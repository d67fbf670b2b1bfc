#include "calibrate/export/deck_template.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <variant>

#include <ctemplate/template.h>
#include <fmt/format.h>

#include "base/text.h"
#include "calibrate/export/templates.h"

namespace repose::calibrate {

namespace {

void fill(const DeckFields& fields, ctemplate::TemplateDictionary& dictionary) {
  for (const auto& [name, value] : fields.values) dictionary.SetValue(name, value);
  for (const DeckFields& section : fields.sections) {
    fill(section, *dictionary.AddSectionDictionary(section.name));
  }
}

}  // namespace

void DeckFields::set(const std::string& field, const std::string& value) {
  std::string line = base::printable(value);
  std::replace_if(
      line.begin(), line.end(), [](char letter) { return letter == '\n' || letter == '\t'; }, ' ');
  values.emplace_back(field, line);
}

void DeckFields::set_lines(const std::string& field, const std::string& text) {
  values.emplace_back(field, text);
}

void DeckFields::set(const std::string& field, double value) { set(field, number(value)); }

void DeckFields::set(const std::string& field, int value) { set(field, std::to_string(value)); }

DeckFields& DeckFields::add_section(const std::string& section) {
  return sections.emplace_back(DeckFields{.name = section, .values = {}, .sections = {}});
}

std::string number(double value) { return fmt::format("{}", value); }

std::string sanitized(std::string_view name) {
  constexpr std::string_view kKept = " _-.,+%";
  std::string saved = base::printable(name);
  for (char& letter : saved) {
    const auto byte = static_cast<unsigned char>(letter);
    const bool is_letter = (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z');
    const bool is_digit = byte >= '0' && byte <= '9';
    if (is_letter || is_digit || byte >= 0x80 || kKept.find(letter) != kKept.npos) continue;
    letter = '_';
  }
  return saved;
}

std::string filled(const std::string& template_name, const DeckFields& fields) {
  const std::string_view text = templates::embedded_file("export/templates/" + template_name);
  const std::unique_ptr<ctemplate::Template> deck(ctemplate::Template::StringToTemplate(
      text.data(), text.size(), ctemplate::STRIP_BLANK_LINES));
  if (!deck) throw std::logic_error("the template " + template_name + " is wrong");
  ctemplate::TemplateDictionary dictionary(template_name);
  fill(fields, dictionary);
  std::string out;
  if (!deck->Expand(&out, &dictionary)) {
    throw std::logic_error("the template " + template_name + " cannot be filled in");
  }
  return out;
}

}  // namespace repose::calibrate
