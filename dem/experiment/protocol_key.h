#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace repose::dem {

/// A range of allowed numbers.
struct Range {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
  bool excludes_from = false;
  bool excludes_to = false;

  bool contains(double value) const;  ///< false for NaN and infinity
  std::string rule() const;           ///< "a number above 0 and at most 100"
};

constexpr Range above(double from, double to = std::numeric_limits<double>::infinity()) {
  return {.from = from, .to = to, .excludes_from = true};
}
constexpr Range between(double from, double to) {
  return {.from = from, .to = to, .excludes_from = true, .excludes_to = true};
}
constexpr Range from_to(double from, double to) { return {.from = from, .to = to}; }
constexpr Range from_to_below(double from, double to) {
  return {.from = from, .to = to, .excludes_to = true};
}

/// A number of a protocol: its key in a study file, and where the protocol stores it.
struct ProtocolKey {
  std::string name;     ///< including the unit: "height_mm"
  std::string example;  ///< a usual value: "500"
  Range range;
  double unit = 1;  ///< of the key, in the protocol's unit: .001 for mm in m
  std::variant<double*, int*, std::optional<double>*, std::optional<int>*> value;
  std::string_view absence = "";  ///< meaning if omitted: "as many as fit"
  /// The key without which it has no effect; its own name if omitting it means no effect.
  std::string needs = {};
  bool is_of_pictures = false;  ///< concerns how pictures are taken, not the simulation
};

ProtocolKey length_key(std::string name_mm, std::string example_mm, double& value_m);
ProtocolKey length_key(std::string name_mm, std::string example_mm, std::optional<double>& value_m,
                       std::string_view absence);
ProtocolKey number_key(std::string name, std::string example, const Range& range, double& value);
/// 1 to `max`.
ProtocolKey count_key(std::string name, std::string example, int max, int& value);
ProtocolKey count_key(std::string name, std::string example, int max, std::optional<int>& value,
                      std::string_view absence);

/// The value in the key's unit; std::nullopt if omitted.
std::optional<double> value_of(const ProtocolKey& key);

/// The keys that have an effect, without those whose `needs` key has no value.
std::vector<ProtocolKey> with_effect(const std::vector<ProtocolKey>& keys);

}  // namespace repose::dem
