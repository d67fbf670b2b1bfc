#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/polygon_file.h"

namespace repose::base {
namespace {

enum class Format { ascii, little_endian, big_endian };
enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Each type has two names.
constexpr std::array<std::pair<std::string_view, Type>, 16> kTypes = {{{"char", Type::int8},
                                                                       {"int8", Type::int8},
                                                                       {"uchar", Type::uint8},
                                                                       {"uint8", Type::uint8},
                                                                       {"short", Type::int16},
                                                                       {"int16", Type::int16},
                                                                       {"ushort", Type::uint16},
                                                                       {"uint16", Type::uint16},
                                                                       {"int", Type::int32},
                                                                       {"int32", Type::int32},
                                                                       {"uint", Type::uint32},
                                                                       {"uint32", Type::uint32},
                                                                       {"float", Type::float32},
                                                                       {"float32", Type::float32},
                                                                       {"double", Type::float64},
                                                                       {"float64", Type::float64}}};

struct Property {
  std::string name;
  std::optional<Type> length;  ///< of a list
  Type type = Type::float32;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
};

[[noreturn]] void refuse_ply(const std::string& where, const std::string& what) {
  throw InputError({.where = where, .value = what});
}

/// Reads the header line by line.
class HeaderReader {
 public:
  explicit HeaderReader(std::string_view bytes) : rest_(bytes) {}

  Header read() {
    if (take_line() != "ply") wrong("a PLY file begins with a line \"ply\"");
    Header header;
    bool has_format = false;
    for (std::string line = take_line(); line != "end_header"; line = take_line()) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word == "format") {
        header.format = format_in(words);
        has_format = true;
      } else if (word == "element") {
        header.elements.push_back(element_in(words));
      } else if (word == "property") {
        if (header.elements.empty()) wrong("a property stands before any element");
        header.elements.back().properties.push_back(property_in(words));
      } else if (!word.empty() && word != "comment" && word != "obj_info") {
        wrong("no header line begins like this");
      }
    }
    if (!has_format) wrong("the header ends without a format");
    return header;
  }

  std::string_view body() const { return rest_; }

 private:
  [[noreturn]] void wrong(const char* what) const {
    refuse_ply(fmt::format("line {} of the header", line_), what);
  }

  std::string take_line() {
    constexpr std::size_t kLongest = 4096;
    ++line_;
    const std::size_t end = rest_.find('\n');
    if (end > kLongest) {  // also if there is none
      wrong("the header is truncated, or this is not a PLY file");
    }
    std::string line(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    line.erase(line.find_last_not_of(" \t\r") + 1);
    return line;
  }

  Format format_in(std::istringstream& words) const {
    std::string name;
    words >> name;
    if (name == "ascii") return Format::ascii;
    if (name == "binary_little_endian") return Format::little_endian;
    if (name == "binary_big_endian") return Format::big_endian;
    wrong("the format is none of ascii, binary_little_endian, binary_big_endian");
  }

  Element element_in(std::istringstream& words) const {
    Element element;
    std::string count;
    words >> element.name >> count;
    const char* end = count.data() + count.size();
    const auto [stopped_at, error] = std::from_chars(count.data(), end, element.count);
    if (count.empty() || error != std::errc{} || stopped_at != end) {
      wrong("an element has a name and a number");
    }
    return element;
  }

  Type type_named(const std::string& name) const {
    for (const auto& [known, type] : kTypes) {
      if (known == name) return type;
    }
    wrong("a property is of no known type");
  }

  Property property_in(std::istringstream& words) const {
    Property property;
    std::string type;
    words >> type;
    if (type == "list") {
      words >> type;
      property.length = type_named(type);
      words >> type;
    }
    property.type = type_named(type);
    words >> property.name;
    if (property.name.empty()) wrong("a property has no name");
    return property;
  }

  std::string_view rest_;
  int line_ = 0;
};

/// Takes numbers from the data after the header, and never reads past the end.
class Body {
 public:
  Body(std::string_view bytes, Format format) : rest_(bytes), format_(format) {}

  double take(Type type, const std::string& where) {
    if (format_ == Format::ascii) return take_text(where);
    switch (type) {
      case Type::int8:
        return take_bytes<std::int8_t>(where);
      case Type::uint8:
        return take_bytes<std::uint8_t>(where);
      case Type::int16:
        return take_bytes<std::int16_t>(where);
      case Type::uint16:
        return take_bytes<std::uint16_t>(where);
      case Type::int32:
        return take_bytes<std::int32_t>(where);
      case Type::uint32:
        return take_bytes<std::uint32_t>(where);
      case Type::float32:
        return static_cast<double>(take_bytes<float>(where));
      case Type::float64:
        break;
    }
    return take_bytes<double>(where);
  }

  /// A whole number, 0 or more.
  std::int64_t take_whole(Type type, const std::string& where) {
    const double number = take(type, where);
    if (!(number >= 0 && number <= std::numeric_limits<std::int32_t>::max()) ||
        number != std::floor(number)) {
      refuse_ply(where, fmt::format("{:g} stands where a whole number from 0 must", number));
    }
    return static_cast<std::int64_t>(number);
  }

 private:
  double take_text(const std::string& where) {
    constexpr std::string_view kBlanks = " \t\r\n";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
    if (rest_.empty()) refuse_ply(where, "the file ends here, too soon");
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlanks));
    const char* end = word.data() + word.size();
    double number = 0;
    const auto [stopped_at, error] =
        std::from_chars(word.data() + (word.starts_with('+') ? 1 : 0), end, number);
    if (error != std::errc{} || stopped_at != end) refuse_ply(where, "this is not a number");
    rest_.remove_prefix(word.size());
    return number;
  }

  template <typename Number>
  Number take_bytes(const std::string& where) {
    std::array<char, sizeof(Number)> bytes{};
    if (rest_.size() < bytes.size()) refuse_ply(where, "the file ends here, too soon");
    std::copy_n(rest_.begin(), bytes.size(), bytes.begin());
    rest_.remove_prefix(bytes.size());
    constexpr Format kOwn =
        std::endian::native == std::endian::little ? Format::little_endian : Format::big_endian;
    if (format_ != kOwn) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Number>(bytes);
  }

  std::string_view rest_;
  Format format_;
};

/// The coordinate that a property is: 0 to 2 for x to z; std::nullopt if it is none.
std::optional<std::size_t> axis_of(const Element& element, const Property& property) {
  if (element.name != "vertex" || property.length || property.name.size() != 1) return std::nullopt;
  const std::size_t axis = std::string_view("xyz").find(property.name);
  return axis == std::string_view::npos ? std::nullopt : std::optional(axis);
}

bool is_corner_list(const Element& element, const Property& property) {
  return element.name == "face" && property.length &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

void read_item(const Element& element, const std::string& where, Body& body,
               PolygonSurface& surface) {
  Corner corner{};
  for (const Property& property : element.properties) {
    if (!property.length) {
      const double number = body.take(property.type, where);
      if (const auto axis = axis_of(element, property)) corner[*axis] = number;
      continue;
    }
    const std::int64_t length = body.take_whole(*property.length, where);
    std::vector<int> face;
    for (std::int64_t k = 0; k < length; ++k) {
      if (is_corner_list(element, property)) {
        face.push_back(static_cast<int>(body.take_whole(property.type, where)));
      } else {
        body.take(property.type, where);
      }
    }
    if (face.size() > 2) surface.faces.push_back(std::move(face));
  }
  if (element.name == "vertex") surface.corners.push_back(corner);
}

void check_element(const Element& element) {
  if (element.count > 0 && element.properties.empty()) {
    refuse_ply("element " + element.name, "it has no properties");
  }
  if (element.name != "vertex") return;
  std::array<bool, 3> has_axis{};
  for (const Property& property : element.properties) {
    if (const auto axis = axis_of(element, property)) has_axis[*axis] = true;
  }
  if (!has_axis[0] || !has_axis[1] || !has_axis[2]) {
    refuse_ply("element vertex", "its properties are not x, y and z");
  }
}

void check_corners(const PolygonSurface& surface) {
  for (std::size_t k = 0; k < surface.faces.size(); ++k) {
    for (const int corner : surface.faces[k]) {
      if (std::cmp_less(corner, surface.corners.size())) continue;
      refuse_ply(fmt::format("face {}", k), fmt::format("it names corner {}, and there are {}",
                                                        corner, surface.corners.size()));
    }
  }
}

}  // namespace

PolygonSurface parse_ply(std::string_view bytes) {
  HeaderReader reader(bytes);
  const Header header = reader.read();
  Body body(reader.body(), header.format);
  PolygonSurface surface;
  for (const Element& element : header.elements) {
    check_element(element);
    for (std::uint64_t k = 0; k < element.count; ++k) {
      read_item(element, fmt::format("{} {} of {}", element.name, k, element.count), body, surface);
    }
  }
  check_corners(surface);
  return surface;
}

}  // namespace repose::base
