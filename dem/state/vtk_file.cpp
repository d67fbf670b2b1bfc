#include "dem/state/vtk_file.h"

#include <bit>
#include <charconv>
#include <cstring>
#include <numeric>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "base/base64.h"
#include "base/input_error.h"

namespace repose::dem {

namespace {

using Bytes = std::vector<std::byte>;

constexpr const char* kReadingFix = "give a .vtp file that repose wrote, unchanged.";

[[noreturn]] void refuse_file(const std::string& file, const std::string& what) {
  throw base::InputError({.where = file, .value = what, .fix = kReadingFix});
}

template <typename Number>
std::vector<Number> numbers_in(std::span<const std::byte> bytes) {
  std::vector<Number> values(bytes.size() / sizeof(Number));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

std::vector<std::string> texts_in(std::span<const std::byte> bytes) {
  std::vector<std::string> texts;
  std::string text;
  for (const std::byte byte : bytes) {
    if (byte == std::byte{0}) {
      texts.push_back(std::exchange(text, {}));
    } else {
      text += static_cast<char>(byte);
    }
  }
  return texts;
}

std::size_t size_of(const VtkArray::Values& values) {
  return std::visit([](const auto& list) { return list.size(); }, values);
}

/// A non-negative integer; otherwise std::nullopt.
std::optional<std::size_t> count_in(const pugi::xml_attribute& attribute) {
  const std::string_view text = attribute.value();
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return count;
}

class Parser {
 public:
  explicit Parser(const std::string& file) : file_(file) {}

  VtkPoints points(const pugi::xml_node& root) const {
    const pugi::xml_node data = child(root, "PolyData");
    const pugi::xml_node piece = child(data, "Piece");
    const auto count = count_in(piece.attribute("NumberOfPoints"));
    if (!count) refuse_file(file_, "NumberOfPoints is not a whole number");
    VtkPoints result;
    result.field_arrays = arrays(child(data, "FieldData"));
    result.point_arrays = arrays(child(piece, "PointData"));
    for (const VtkArray& values : result.point_arrays) check_count(values, *count);
    const VtkArray positions = array(child(child(piece, "Points"), "DataArray"));
    check_count(positions, *count);
    const auto* numbers = std::get_if<std::vector<double>>(&positions.values);
    if (numbers == nullptr || positions.components != 3) {
      refuse_file(file_, "the points are not three Float64 each");
    }
    result.positions = *numbers;
    return result;
  }

 private:
  pugi::xml_node child(const pugi::xml_node& node, const char* name) const {
    const pugi::xml_node found = node.child(name);
    if (!found) refuse_file(file_, fmt::format("it has no <{}>", name));
    return found;
  }

  std::vector<VtkArray> arrays(const pugi::xml_node& node) const {
    std::vector<VtkArray> result;
    for (const pugi::xml_node& element : node.children("DataArray")) {
      result.push_back(array(element));
    }
    return result;
  }

  VtkArray array(const pugi::xml_node& element) const {
    VtkArray result;
    result.name = element.attribute("Name").value();
    result.components = element.attribute("NumberOfComponents").as_int(1);
    if (std::string_view(element.attribute("format").value()) != "binary") {
      refuse_file(file_, fmt::format("array {} is not in format \"binary\"", result.name));
    }
    result.values = values(element, result.name);
    if (result.components < 1 ||
        size_of(result.values) % static_cast<std::size_t>(result.components) != 0) {
      refuse_file(
          file_, fmt::format("array {} has {} values, which is not a multiple of its {} components",
                             result.name, size_of(result.values), result.components));
    }
    return result;
  }

  VtkArray::Values values(const pugi::xml_node& element, const std::string& name) const {
    const auto bytes = base::bytes_of_base64(element.child_value());
    std::uint64_t promised = 0;
    if (!bytes || bytes->size() < sizeof promised) {
      refuse_file(file_, fmt::format("array {} is not base64, or is truncated", name));
    }
    std::memcpy(&promised, bytes->data(), sizeof promised);
    const auto content = std::span(*bytes).subspan(sizeof promised);
    if (promised != content.size()) {
      refuse_file(file_, fmt::format("array {} says it has {} bytes and has {}", name, promised,
                                     content.size()));
    }
    const std::string_view type = element.attribute("type").value();
    if (type == "String") return texts_in(content);
    if (content.size() % sizeof(double) != 0) {
      refuse_file(file_, fmt::format("array {} ends within a number", name));
    }
    if (type == "Float64") return numbers_in<double>(content);
    if (type == "Int64") return numbers_in<std::int64_t>(content);
    refuse_file(file_,
                fmt::format("array {} is of type {}, not Float64, Int64 or String", name, type));
  }

  void check_count(const VtkArray& values, std::size_t points) const {
    const std::size_t tuples = size_of(values.values) / static_cast<std::size_t>(values.components);
    if (tuples != points) {
      refuse_file(file_, fmt::format("array {} is for {} points, there are {}", values.name, tuples,
                                     points));
    }
  }

  const std::string& file_;
};

}  // namespace

VtkPoints parse_vtk(const std::string& file, std::string_view text) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  const pugi::xml_node root = document.child("VTKFile");
  if (!result) {
    refuse_file(file, fmt::format("no whole XML file: {} at byte {} of {}", result.description(),
                                  result.offset, text.size()));
  }
  const std::string_view type = root.attribute("type").value();
  const std::string_view order = root.attribute("byte_order").value();
  const std::string_view header = root.attribute("header_type").value();
  if (type != "PolyData" || order != "LittleEndian" || header != "UInt64" ||
      root.attribute("compressor")) {
    refuse_file(file,
                "no VTK PolyData file as repose writes them (little endian, UInt64, not packed)");
  }
  return Parser(file).points(root);
}

namespace {

static_assert(std::endian::native == std::endian::little, "the file says little endian");

using Bytes = std::vector<std::byte>;

template <typename Number>
Bytes bytes_of(const std::vector<Number>& values) {
  Bytes bytes(values.size() * sizeof(Number));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// Concatenated zero-terminated strings.
Bytes bytes_of(const std::vector<std::string>& texts) {
  Bytes bytes;
  for (const std::string& text : texts) {
    for (const char letter : text) bytes.push_back(static_cast<std::byte>(letter));
    bytes.push_back(std::byte{0});
  }
  return bytes;
}

const char* type_name(const VtkArray::Values& values) {
  constexpr const char* kNames[] = {"Float64", "Int64", "String"};
  return kNames[values.index()];
}

std::string array_element(const VtkArray& array, bool is_field) {
  const Bytes content =
      std::visit([](const auto& values) { return bytes_of(values); }, array.values);
  const std::uint64_t size = content.size();
  Bytes all(sizeof size);
  std::memcpy(all.data(), &size, sizeof size);
  all.insert(all.end(), content.begin(), content.end());
  const std::size_t count =
      std::visit([](const auto& values) { return values.size(); }, array.values);
  const std::string tuples = is_field
                                 ? fmt::format(" NumberOfTuples=\"{}\"",
                                               count / static_cast<std::size_t>(array.components))
                                 : "";
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"binary\">{}"
      "</DataArray>\n",
      type_name(array.values), array.name, array.components, tuples, base::base64_of(all));
}

std::string elements(const std::vector<VtkArray>& arrays, bool is_field) {
  std::string text;
  for (const VtkArray& array : arrays) text += array_element(array, is_field);
  return text;
}

/// One vertex cell per point.
std::string vertices(std::size_t points) {
  std::vector<std::int64_t> connectivity(points), offsets(points);
  std::iota(connectivity.begin(), connectivity.end(), 0);
  std::iota(offsets.begin(), offsets.end(), 1);
  return elements(
      {{.name = "connectivity", .values = connectivity}, {.name = "offsets", .values = offsets}},
      false);
}

}  // namespace

std::string vtk_text(const VtkPoints& points) {
  const std::size_t count = points.positions.size() / 3;
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n{}</FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n<PointData>\n{}</PointData>\n<Points>\n{}</Points>\n"
      "<Verts>\n{}</Verts>\n</Piece>\n</PolyData>\n</VTKFile>\n",
      elements(points.field_arrays, true), count, count, elements(points.point_arrays, false),
      array_element({.name = "position", .components = 3, .values = points.positions}, false),
      vertices(count));
}

}  // namespace repose::dem
