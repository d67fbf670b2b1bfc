#include "calibrate/report/wording.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "base/distributions.h"
#include "dem/experiment/experiment_table.h"

namespace repose::calibrate::report {
namespace {

bool is_inside_letter(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

/// An exponent.
std::string raised(long power) {
  constexpr std::array<const char*, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                   "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = power < 0 ? "⁻" : "";
  for (const char digit : fmt::format("{}", std::abs(power))) {
    text += kDigits.at(static_cast<std::size_t>(digit - '0'));
  }
  return text;
}

}  // namespace

std::string shown(std::optional<double> value, std::optional<int> decimals) {
  if (!value || !std::isfinite(*value)) return "–";
  std::string text =
      decimals ? fmt::format("{:.{}f}", *value, *decimals) : fmt::format("{:.4g}", *value);
  if (const std::size_t e = text.find('e'); e != std::string::npos) {
    text = text.substr(0, e) + "·10" + raised(std::strtol(text.c_str() + e + 1, nullptr, 10));
  }
  // A hyphen is too short for a minus sign.
  return text.starts_with('-') ? "−" + text.substr(1) : text;
}

std::string shown(const Cell& cell, const Column& column) {
  if (const auto* number = std::get_if<double>(&cell)) return shown(*number, column.decimals);
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return "–";
}

std::string spaced(std::string name) {
  for (char& letter : name) {
    if (letter == '_') letter = ' ';
  }
  return name;
}

std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t head = most * 2 / 3, tail = text.size() - most / 3;
  while (head > 0 && is_inside_letter(text[head])) --head;
  while (tail < text.size() && is_inside_letter(text[tail])) ++tail;
  return text.substr(0, head) + "…" + text.substr(tail);
}

std::string label_of(const std::string& parameter) {
  constexpr std::string_view kContact = "contact.";
  const std::size_t start = parameter.starts_with(kContact) ? kContact.size() : 0;
  const std::size_t dot = parameter.find('.', start);
  if (dot == std::string::npos) return shortened(spaced(parameter.substr(start)));
  const std::string pair = parameter.substr(start, dot - start);
  const std::string what = spaced(parameter.substr(dot + 1));
  for (const char* other : {"wall", "particle", "tube", "incline", "pane"}) {
    if (pair == std::string("particle_") + other) return shortened(what + ", particle–" + other);
  }
  return shortened(what + ", " + spaced(pair));
}

std::string unit_of_experiment(const std::string& name) {
  const auto* known = dem::find_experiment(name);
  return known == nullptr ? "" : std::string(known->unit);
}

std::string unit_shown(const std::string& unit) {
  if (unit == "deg") return "°";
  return unit == "kg/m3" ? "kg/m³" : unit;
}

std::string axis_of_observable(const std::string& name, const std::string& unit) {
  // For additional readings, "drop.low_rebound_mm", the unit is given at the end.
  const std::size_t dot = name.find('.');
  const auto* known = dem::find_experiment(name.substr(0, dot));
  std::string what = shortened(spaced(name));
  if (known != nullptr && dot == std::string::npos) what = known->value_name;
  if (known != nullptr && dot != std::string::npos) {
    std::string reading = name.substr(dot + 1);
    if (!unit.empty() && reading.ends_with('_' + unit))
      reading.resize(reading.size() - unit.size() - 1);
    what = fmt::format("{}, {}", spaced(std::string(known->name)), shortened(spaced(reading)));
  }
  if (unit.empty()) return what;
  return fmt::format("{} [{}]", what, unit_shown(unit));
}

bool has_heap(const StudyResult& result) {
  if (!result.provenance.model) return false;
  const NamedValues& experiments = result.provenance.model->stiffness_factor;
  return std::any_of(experiments.begin(), experiments.end(), [](const auto& experiment) {
    return experiment.first == dem::pictured_experiment().name;
  });
}

std::string titled(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string title_of_parameter(const std::string& name) {
  const std::string label = label_of(name);
  return label == name ? name : titled(label);
}

std::string file_stem(const std::string& text) {
  constexpr std::size_t kLongest = 100;
  constexpr std::string_view kContact = "contact.";
  std::string name = text;
  for (std::size_t at = name.find(kContact); at != std::string::npos; at = name.find(kContact)) {
    name.erase(at, kContact.size());
  }
  std::string stem;
  for (const char letter : name.substr(0, kLongest)) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
    if (is_plain) {
      stem += letter;
    } else if (!stem.empty() && stem.back() != '_') {
      stem += '_';
    }
  }
  return stem.empty() ? "table" : stem;
}

double half_width_95(double standard_uncertainty, double df) {
  constexpr double kUpper = .975;
  if (standard_uncertainty == 0 || !(df >= 1)) return base::kNormal95 * standard_uncertainty;
  if (!std::isfinite(df)) return base::kNormal95 * standard_uncertainty;
  return base::student_t_quantile(kUpper, df) * standard_uncertainty;
}

double readable(double value, const std::string& unit) {
  const dem::Range range = dem::readable_in(unit);
  return std::clamp(value, range.from, range.to);
}

Cell cell(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return std::monostate{};
  return *value;
}

Cell cell(const std::string& text) { return text; }

}  // namespace repose::calibrate::report
