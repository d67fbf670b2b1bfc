#include "dem/experiment/protocol_key.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/units.h"

namespace repose::dem {

bool Range::contains(double value) const {
  return std::isfinite(value) && (excludes_from ? value > from : value >= from) &&
         (excludes_to ? value < to : value <= to);
}

std::string Range::rule() const {
  std::string text = "a number";
  if (std::isfinite(from))
    text += fmt::format(" {} {:g}", excludes_from ? "above" : "of at least", from);
  if (std::isfinite(to)) {
    text += fmt::format("{} {} {:g}", std::isfinite(from) ? " and" : "",
                        excludes_to ? "below" : "at most", to);
  }
  return text;
}

namespace {

constexpr double kLongest_mm = 1e5;

template <typename Number>
std::optional<double> in_unit(const std::optional<Number>& number, double unit) {
  return number ? std::optional<double>(*number / unit) : std::nullopt;
}

}  // namespace

ProtocolKey length_key(std::string name_mm, std::string example_mm, double& value_m) {
  return {.name = std::move(name_mm),
          .example = std::move(example_mm),
          .range = above(0, kLongest_mm),
          .unit = kMPerMm,
          .value = &value_m};
}

ProtocolKey length_key(std::string name_mm, std::string example_mm, std::optional<double>& value_m,
                       std::string_view absence) {
  return {.name = std::move(name_mm),
          .example = std::move(example_mm),
          .range = above(0, kLongest_mm),
          .unit = kMPerMm,
          .value = &value_m,
          .absence = absence};
}

ProtocolKey number_key(std::string name, std::string example, const Range& range, double& value) {
  return {.name = std::move(name),
          .example = std::move(example),
          .range = range,
          .unit = 1,
          .value = &value};
}

ProtocolKey count_key(std::string name, std::string example, int max, int& value) {
  return {.name = std::move(name),
          .example = std::move(example),
          .range = from_to(1, max),
          .unit = 1,
          .value = &value};
}

ProtocolKey count_key(std::string name, std::string example, int max, std::optional<int>& value,
                      std::string_view absence) {
  return {.name = std::move(name),
          .example = std::move(example),
          .range = from_to(1, max),
          .unit = 1,
          .value = &value,
          .absence = absence};
}

std::optional<double> value_of(const ProtocolKey& key) {
  if (double* const* number = std::get_if<double*>(&key.value)) return **number / key.unit;
  if (int* const* whole = std::get_if<int*>(&key.value)) return **whole;
  if (std::optional<double>* const* number = std::get_if<std::optional<double>*>(&key.value)) {
    return in_unit(**number, key.unit);
  }
  return in_unit(*std::get<std::optional<int>*>(key.value), key.unit);
}

std::vector<ProtocolKey> with_effect(const std::vector<ProtocolKey>& keys) {
  std::vector<ProtocolKey> those;
  for (const ProtocolKey& key : keys) {
    const auto needed = std::ranges::find(keys, key.needs, &ProtocolKey::name);
    if (needed == keys.end() || value_of(*needed)) those.push_back(key);
  }
  return those;
}

}  // namespace repose::dem
