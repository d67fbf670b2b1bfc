#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

/// A struct is described once, by `fields(io, value)`, which names each of its fields; JsonWriter
/// and JsonReader both follow this description.
namespace repose::calibrate {

using Json = nlohmann::ordered_json;

/// Names that replace indices in a result: set and used by `fields`.
struct NamesInUse {
  std::vector<std::string> parameters;
  std::vector<std::string> observables;
  std::vector<std::string> factors;
};

/// A field's type as `Io` needs it, for writing or reading.
template <typename Io, typename T>
using Held = typename Io::template Field<T>;

template <typename T>
inline constexpr bool kIsOptional = false;
template <typename T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <typename T>
inline constexpr bool kIsVector = false;
template <typename T>
inline constexpr bool kIsVector<std::vector<T>> = true;
template <typename T>
inline constexpr bool kIsArray = false;
template <typename T, std::size_t kSize>
inline constexpr bool kIsArray<std::array<T, kSize>> = true;
/// Two numbers, written as a list of them.
template <typename T>
inline constexpr bool kIsPair = false;
/// Numbers by name; std::nullopt becomes null.
template <typename T>
inline constexpr bool kIsNamed = std::is_same_v<T, std::map<std::string, double>> ||
                                 std::is_same_v<T, std::vector<std::pair<std::string, double>>> ||
                                 std::is_base_of_v<std::map<std::string, std::optional<double>>, T>;

/// Builds a JSON object from the described fields.
class JsonWriter {
 public:
  template <typename T>
  using Field = const T;
  static constexpr bool kReads = false;

  explicit JsonWriter(NamesInUse& names) : names_(names) {}
  NamesInUse& names() { return names_; }
  Json take() { return std::move(json_); }

  template <typename T>
  void operator()(const std::string& key, const T& value) {
    json_[key] = written(value);
  }
  /// A nested object of the fields that `describe` names.
  template <typename Describe>
  void object(const std::string& key, const Describe& describe) {
    JsonWriter inner(names_);
    describe(inner);
    json_[key] = inner.take();
  }
  /// Derived from other fields; only for readers of the file.
  void derived(const std::string& key, std::optional<double> value) { (*this)(key, value); }
  /// Text; null if empty.
  void text_or_null(const std::string& key, const std::string& text) {
    json_[key] = text.empty() ? Json(nullptr) : Json(text);
  }
  /// Whether an optional field is to be described.
  bool has(const std::string&, bool is_there) const { return is_there; }
  void place(const std::string& key, const std::vector<std::string>& names, std::size_t place) {
    json_[key] = names.at(place);
  }

 private:
  template <typename T>
  Json written(const T& value) {
    if constexpr (std::is_floating_point_v<T>) {
      return std::isfinite(value) ? Json(value) : Json(nullptr);
    } else if constexpr (std::is_integral_v<T> || std::is_same_v<T, std::string>) {
      return value;
    } else if constexpr (std::is_enum_v<T>) {
      return name_of(value);
    } else if constexpr (kIsOptional<T>) {
      return value ? written(*value) : Json(nullptr);
    } else if constexpr (kIsPair<T>) {
      const auto& [first, second] = value;
      return Json::array({written(first), written(second)});
    } else if constexpr (kIsNamed<T>) {
      Json json = Json::object();
      for (const auto& [name, number] : value) json[name] = written(number);
      return json;
    } else if constexpr (kIsVector<T> || kIsArray<T>) {
      Json json = Json::array();
      for (const auto& item : value) json.push_back(written(item));
      return json;
    } else {
      JsonWriter inner(names_);
      fields(inner, value);
      return inner.take();
    }
  }

  NamesInUse& names_;
  Json json_ = Json::object();
};

/// A missing or invalid field; what() begins with its path.
class WrongField : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads an object field by field. Unknown keys are ignored.
class JsonReader {
 public:
  template <typename T>
  using Field = T;
  static constexpr bool kReads = true;

  /// @param path  location of the object: "observables[2]", or empty
  JsonReader(const Json& json, std::string path, NamesInUse& names)
      : json_(json), path_(std::move(path)), names_(names) {
    if (!json.is_object()) refuse(path_, "must be an object");
  }
  NamesInUse& names() { return names_; }

  template <typename T>
  void operator()(const std::string& key, T& value) {
    read(at(key), path_of(key), value);
  }
  template <typename Describe>
  void object(const std::string& key, const Describe& describe) {
    JsonReader inner(at(key), path_of(key), names_);
    describe(inner);
  }
  void derived(const std::string&, std::optional<double>) const {}
  void text_or_null(const std::string& key, std::string& text) {
    if (at(key).is_null()) {
      text.clear();
    } else {
      (*this)(key, text);
    }
  }
  bool has(const std::string& key, bool) const { return json_.contains(key); }
  void place(const std::string& key, const std::vector<std::string>& names, std::size_t& place) {
    std::string name;
    (*this)(key, name);
    place = 0;
    while (place < names.size() && names[place] != name) ++place;
    if (place == names.size()) refuse(path_of(key), fmt::format("\"{}\" is not known here", name));
  }
  [[noreturn]] static void refuse(const std::string& path, const std::string& rule) {
    throw WrongField(fmt::format("{}: {}", path.empty() ? "all of it" : path, rule));
  }

 private:
  std::string path_of(const std::string& key) const {
    return path_.empty() ? key : path_ + '.' + key;
  }
  const Json& at(const std::string& key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) refuse(path_of(key), "is missing");
    return *found;
  }

  template <typename T>
  void read(const Json& json, const std::string& path, T& value) {
    if constexpr (std::is_same_v<T, double>) {
      if (!json.is_number() && !json.is_null()) refuse(path, "must be a number or null");
      value = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
    } else if constexpr (std::is_same_v<T, bool>) {
      if (!json.is_boolean()) refuse(path, "must be true or false");
      value = json.get<bool>();
    } else if constexpr (std::is_integral_v<T>) {
      if (!json.is_number_integer()) refuse(path, "must be a whole number");
      value = json.get<T>();
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (!json.is_string()) refuse(path, "must be text");
      value = json.get<std::string>();
    } else if constexpr (std::is_enum_v<T>) {
      read_enum(json, path, value);
    } else if constexpr (kIsOptional<T>) {
      value.reset();
      if (!json.is_null()) read(json, path, value.emplace());
    } else if constexpr (kIsPair<T>) {
      std::array<double, 2> pair{};
      read(json, path, pair);
      value = {pair[0], pair[1]};
    } else if constexpr (kIsNamed<T>) {
      read_named(json, path, value);
    } else if constexpr (kIsVector<T> || kIsArray<T>) {
      read_list(json, path, value);
    } else {
      JsonReader inner(json, path, names_);
      fields(inner, value);
    }
  }

  template <typename T>
  void read_enum(const Json& json, const std::string& path, T& value) {
    std::string name, known;
    read(json, path, name);
    for (const auto& [each, its_name] : names_for(T{})) {
      if (its_name == name) {
        value = each;
        return;
      }
      known += fmt::format("{}{}", known.empty() ? "" : ", ", its_name);
    }
    refuse(path, fmt::format("\"{}\" must be one of {}", name, known));
  }

  template <typename T>
  void read_named(const Json& json, const std::string& path, T& value) {
    if (!json.is_object()) refuse(path, "must be an object");
    value.clear();
    for (const auto& [name, item] : json.items()) {
      decltype(value.begin()->second) number{};
      read(item, path + '.' + name, number);
      value.insert(value.end(), {name, number});
    }
  }

  template <typename T>
  void read_list(const Json& json, const std::string& path, T& value) {
    if (!json.is_array()) refuse(path, "must be a list");
    if constexpr (kIsVector<T>) value.resize(json.size());
    if (json.size() != value.size()) {
      refuse(path, fmt::format("must have {} items, has {}", value.size(), json.size()));
    }
    for (std::size_t k = 0; k < value.size(); ++k) {
      read(json[k], fmt::format("{}[{}]", path, k), value[k]);
    }
  }

  const Json& json_;
  std::string path_;
  NamesInUse& names_;
};

/// A struct without index fields as JSON, and read from it.
template <typename T>
Json json_of_fields(const T& value) {
  NamesInUse none;
  JsonWriter writer(none);
  fields(writer, value);
  return writer.take();
}
/// @throws WrongField  a field is missing or invalid.
template <typename T>
void read_fields(const Json& json, T& value) {
  NamesInUse none;
  JsonReader reader(json, "", none);
  fields(reader, value);
}

/// The items of `values` as fields with these names.
template <typename Io, typename Values>
void spread(Io& io, const std::vector<std::string>& names, Values& values) {
  if constexpr (Io::kReads) values.resize(names.size());
  for (std::size_t k = 0; k < values.size(); ++k) io(names.at(k), values[k]);
}

/// The same in a nested object.
template <typename Io, typename Values>
void by_name(Io& io, const std::string& key, const std::vector<std::string>& names,
             Values& values) {
  io.object(key, [&](Io& inner) { spread(inner, names, values); });
}

}  // namespace repose::calibrate
