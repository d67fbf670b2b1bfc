#include <charconv>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "base/base64.h"
#include "base/input_error.h"
#include "dem/state/vtk_file.h"

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

/// A whole number of 0 or more; none otherwise.
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

}  // namespace repose::dem
