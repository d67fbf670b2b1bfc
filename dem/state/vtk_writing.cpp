#include <bit>
#include <cstring>
#include <numeric>
#include <type_traits>

#include <fmt/format.h>

#include "base/base64.h"
#include "dem/state/vtk_file.h"

namespace repose::dem {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says little endian");

using Bytes = std::vector<std::byte>;

template <typename Number>
Bytes bytes_of(const std::vector<Number>& values) {
  Bytes bytes(values.size() * sizeof(Number));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// Strings follow each other, each with a zero at its end.
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

/// One vertex cell for each point.
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
