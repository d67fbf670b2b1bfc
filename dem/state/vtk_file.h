#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace repose::dem {

/// Named values of a VTK file, `components` to a tuple.
struct VtkArray {
  using Values =
      std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::string>>;

  std::string name;
  int components = 1;
  Values values;
};

/// Points with values, and values that belong to the whole.
struct VtkPoints {
  std::vector<double> positions;  ///< x, y, z of each
  std::vector<VtkArray> point_arrays;
  std::vector<VtkArray> field_arrays;
};

/// The text of a .vtp file (VTK XML PolyData 1.0): each point is a vertex cell, so that it is
/// drawn. Numbers are Float64 or Int64, little endian, as base64 behind a UInt64 with their bytes:
/// exact.
std::string vtk_text(const VtkPoints& points);

/// Reads what vtk_text writes. `file` is what errors call it.
/// @throws base::InputError  another kind of file, or one that is cut short or edited.
VtkPoints parse_vtk(const std::string& file, std::string_view text);

}  // namespace repose::dem
