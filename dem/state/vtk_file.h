#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace repose::dem {

/// Named values of a VTK file, `components` per tuple.
struct VtkArray {
  using Values =
      std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::string>>;

  std::string name;
  int components = 1;
  Values values;
};

/// Points with values, and values of the whole data set.
struct VtkPoints {
  std::vector<double> positions;  ///< x, y, z of each point
  std::vector<VtkArray> point_arrays;
  std::vector<VtkArray> field_arrays;
};

/// The text of a .vtp file (VTK XML PolyData 1.0): each point has a vertex cell, so that it is
/// drawn. Numbers are Float64 or Int64, little endian, in base64 after a UInt64 byte count: exact.
std::string vtk_text(const VtkPoints& points);

/// Reads what vtk_text writes. `file` appears in errors.
/// @throws base::InputError  another kind of file, or truncated or edited.
VtkPoints parse_vtk(const std::string& file, std::string_view text);

}  // namespace repose::dem
