#include "cli/statistics/factor_options.h"

#include <string_view>

#include <fmt/format.h>

#include "cli/common/number.h"

namespace repose::cli {
namespace {

/// What a column of a table may be called without quotes, and a factor in a model's terms.
bool is_plain_name(std::string_view name) {
  return !name.empty() && name.find_first_of(" ,;:\"\t\r\n*^") == std::string_view::npos;
}

}  // namespace

std::optional<calibrate::Factor> factor_in(const std::string& option, const std::string& text,
                                           std::vector<std::string>& errors) {
  const std::size_t equals = text.find('=');
  const std::size_t colon = text.find(':', equals == std::string::npos ? 0 : equals);
  if (equals != std::string::npos && colon != std::string::npos) {
    const auto low =
        number_in<double>(std::string_view(text).substr(equals + 1, colon - equals - 1));
    const auto high = number_in<double>(std::string_view(text).substr(colon + 1));
    const std::string name = text.substr(0, equals);
    if (low && high && *low < *high && is_plain_name(name)) {
      return calibrate::Factor{name, *low, *high};
    }
  }
  errors.push_back(fmt::format(
      "{0} {1}: must be a name without blanks and two levels, the lower one first. Fix: "
      "{0} friction=0.1:0.3.",
      option, text));
  return std::nullopt;
}

std::optional<std::pair<std::string, double>> named_number_in(const std::string& option,
                                                              const std::string& text,
                                                              std::vector<std::string>& errors) {
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos) {
    const auto number = number_in<double>(std::string_view(text).substr(equals + 1));
    const std::string name = text.substr(0, equals);
    if (number && is_plain_name(name)) return std::pair(name, *number);
  }
  errors.push_back(fmt::format(
      "{0} {1}: must be a name without blanks and a number. Fix: {0} friction=0.1.", option, text));
  return std::nullopt;
}

}  // namespace repose::cli
