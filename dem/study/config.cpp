#include "dem/study/config.h"

#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "base/toml_nesting.h"

namespace repose::dem {

std::string Place::text() const {
  return setting == 0 ? fmt::format("{}:{}:{}", file, line, column)
                      : fmt::format("{}:{}:{}", base::field(file), setting, column);
}

void StudyErrors::add(const Place& place, const std::string& what, const std::string& rule,
                      const std::string& fix) {
  errors_.push_back(
      {place, {.where = place.text(), .value = what, .rule = rule, .fix = fix + '.'}});
}

void StudyErrors::throw_if_any() const {
  std::vector<Error> sorted = errors_;
  const auto order = [](const Error& error) {
    return std::tuple(error.place.setting, error.place.line, error.place.column);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Error& a, const Error& b) { return order(a) < order(b); });
  constexpr std::size_t kMax = 100;  // errors listed
  std::vector<base::Fault> faults;
  for (const Error& error : sorted) {
    if (faults.size() < kMax) faults.push_back(error.fault);
  }
  if (sorted.size() > kMax) {
    faults.push_back(
        {.value = fmt::format("and {} more, which are not listed", sorted.size() - kMax),
         .fix = "correct these first."});
  }
  if (!faults.empty()) throw base::InputError(std::move(faults));
}

namespace {

using Kind = ConfigValue::Kind;

/// Byte offset of the UTF-8 character number `column` (from 1) in a line.
std::size_t byte_of(std::string_view line, std::size_t column) {
  std::size_t at = 0;
  for (std::size_t letter = 1; at < line.size(); ++at) {
    const bool starts_letter = (static_cast<unsigned char>(line[at]) & 0xC0) != 0x80;
    if (starts_letter && letter++ == column) break;
  }
  return at;
}

/// A text whose parts can be quoted as typed.
class SourceText {
 public:
  SourceText(std::string text, Place file) : text_(std::move(text)), file_(std::move(file)) {
    for (std::size_t start = 0; start <= text_.size();) {
      const std::size_t end = std::min(text_.find('\n', start), text_.size());
      lines_.push_back(std::string_view(text_).substr(start, end - start));
      start = end + 1;
    }
  }
  SourceText(const SourceText&) = delete;  // its lines point into its text
  SourceText& operator=(const SourceText&) = delete;
  SourceText(SourceText&&) = delete;
  SourceText& operator=(SourceText&&) = delete;
  ~SourceText() = default;

  const std::string& text() const { return text_; }
  Place place(const toml::source_region& source) const {
    Place place = file_;
    place.line = static_cast<int>(source.begin.line);
    place.column = static_cast<int>(source.begin.column);
    return place;
  }
  /// The first line of the given region.
  std::string shown(const toml::source_region& source) const {
    if (source.begin.line < 1 || source.begin.line > lines_.size()) return {};
    const std::string_view line = lines_[source.begin.line - 1];
    const std::size_t start = byte_of(line, source.begin.column);
    if (source.end.line != source.begin.line) return cut(line.substr(start)) + " ...";
    return cut(line.substr(start, byte_of(line, source.end.column) - start));
  }

 private:
  /// Enough to recognise it.
  static std::string cut(std::string_view shown) {
    constexpr std::size_t kMaxLetters = 120;
    const std::size_t end = byte_of(shown, kMaxLetters + 1);
    return std::string(shown.substr(0, end)) + (end < shown.size() ? "..." : "");
  }

  std::string text_;
  std::vector<std::string_view> lines_;
  Place file_;
};

ConfigValue converted(const toml::node& node, const std::string& name, const SourceText& source) {
  ConfigValue value;
  value.name = name;
  value.place = source.place(node.source());
  value.shown = source.shown(node.source());
  node.visit([&](const auto& actual) {
    using Node = std::decay_t<decltype(actual)>;
    if constexpr (std::is_same_v<Node, toml::table>) {
      value.kind = Kind::table;
      value.is_inline = actual.is_inline();
      if (!value.is_inline) value.shown = "a section";
      for (const auto& [key, item] : actual) {
        value.items.push_back(converted(item, std::string(key.str()), source));
      }
    } else if constexpr (std::is_same_v<Node, toml::array>) {
      value.kind = Kind::array;
      for (const toml::node& item : actual) value.items.push_back(converted(item, {}, source));
    } else if constexpr (std::is_same_v<Node, toml::value<std::string>>) {
      value.kind = Kind::text;
      value.text = actual.get();
    } else if constexpr (std::is_same_v<Node, toml::value<std::int64_t>>) {
      value.kind = Kind::integer;
      value.integer = actual.get();
      value.number = static_cast<double>(actual.get());
    } else if constexpr (std::is_same_v<Node, toml::value<double>>) {
      value.kind = Kind::number;
      value.number = actual.get();
    } else {
      value.kind = std::is_same_v<Node, toml::value<bool>> ? Kind::boolean : Kind::time;
    }
  });
  return value;
}

/// Merges sections, replaces everything else.
void lay_over(ConfigValue& below, const ConfigValue& above) {
  for (const ConfigValue& item : above.items) {
    const auto same = std::find_if(below.items.begin(), below.items.end(),
                                   [&](const ConfigValue& one) { return one.name == item.name; });
    if (same == below.items.end()) {
      below.items.push_back(item);
    } else if (item.kind == Kind::table && !item.is_inline && same->kind == Kind::table) {
      lay_over(*same, item);
    } else {
      *same = item;
    }
  }
}

/// Adds the zeros that TOML requires around a decimal point: "x=.4" becomes "x=0.4", "x=5." becomes
/// "x=5.0". Quoted text and points in keys are unchanged.
std::string with_zeros(const std::string& setting) {
  const auto is_digit = [](char letter) { return letter >= '0' && letter <= '9'; };
  std::string text;
  char quote = 0;   // the open one, if any
  char before = 0;  // the previous letter, ignoring signs
  bool is_value = false;
  for (std::size_t at = 0; at < setting.size(); ++at) {
    const char letter = setting[at];
    const char next = at + 1 < setting.size() ? setting[at + 1] : ' ';
    if (quote == 0 && (letter == '"' || letter == '\'')) {
      quote = letter;
    } else if (letter == quote) {
      quote = 0;
    } else if (quote == '"' && letter == '\\') {
      text += letter;  // and the escaped letter
      text += next;
      ++at;
      continue;
    }
    is_value = is_value || letter == '=';
    const bool is_point = letter == '.' && quote == 0 && is_value;
    const bool begins = std::string_view("=[,{ \t").find(before) != std::string_view::npos;
    if (is_point && begins && is_digit(next)) text += '0';
    text += letter;
    if (is_point && is_digit(before) && !is_digit(next)) text += '0';
    if (letter != '+' && letter != '-') before = letter;
  }
  return text;
}

ConfigValue parsed(const SourceText& source, const std::string& fix, StudyErrors& errors) {
  if (const auto line = base::line_of_deep_key(source.text())) {
    Place place = source.place({});
    place.line = *line;
    place.column = 1;
    errors.add(place, "a key has too many parts",
               fmt::format("at most {} points in a key", base::kMaxPointsInAKey), fix);
    return {};
  }
  try {
    return converted(toml::parse(std::string_view(source.text())), {}, source);
  } catch (const toml::parse_error& error) {
    ConfigValue nothing;
    nothing.place = source.place(error.source());
    errors.add(nothing.place, std::string(error.description()),
               "the text must be TOML (https://toml.io)", fix);
    return nothing;
  }
}

}  // namespace

const ConfigValue* ConfigValue::find(const std::string& key) const {
  if (kind != Kind::table) return nullptr;
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&](const ConfigValue& item) { return item.name == key; });
  return found == items.end() ? nullptr : &*found;
}

ConfigValue parse_config(const std::string& file, const std::string& text,
                         const std::vector<std::string>& settings, StudyErrors& errors) {
  ConfigValue config =
      parsed(SourceText(text, {.file = file}),
             "correct this line: numbers are written as 0.5, texts in quotes", errors);
  for (std::size_t k = 0; k < settings.size(); ++k) {
    const Place place{.file = "setting", .setting = static_cast<int>(k) + 1};
    const std::string fix =
        "write " + settings[k] +
        " as key.path=value: numbers as 0.5, and text in quotes, as particle.scan=\"nut.stl\"";
    lay_over(config, parsed(SourceText(with_zeros(settings[k]), place), fix, errors));
  }
  return config;
}

}  // namespace repose::dem
