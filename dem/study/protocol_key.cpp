#include "dem/study/protocol_key.h"

#include <algorithm>

#include "base/units.h"

namespace repose::dem {

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
