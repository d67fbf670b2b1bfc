#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "base/base64.h"
#include "dem/shape/clump/clump_shape.h"

/// Particle files as simulation programs write them, made from a synthetic heap.
namespace repose::testing {

using Spheres = std::vector<dem::ClumpSphere>;

/// Spheres in close-packed layers in a cone on the plate z = 0, each slightly displaced.
inline Spheres packed_cone(double angle_deg, double height_m, double radius_m) {
  std::mt19937 random(5);
  const auto off = [&] { return .04 * radius_m * (static_cast<double>(random()) / 0x1p32 - .5); };
  Spheres spheres;
  const double slope = std::tan(angle_deg * std::numbers::pi / 180);
  const double wide = 2 * radius_m, deep = std::sqrt(3.) * radius_m;
  double z = radius_m;
  for (int layer = 0; z < height_m; ++layer, z += wide * std::sqrt(2. / 3)) {
    const double reach = (height_m - (z - radius_m)) / slope - radius_m;
    const int rows = static_cast<int>(reach / deep) + 1;
    for (int j = -rows; j <= rows; ++j) {
      for (int i = -2 * rows; i <= 2 * rows; ++i) {
        const double x = wide * (i + .5 * (std::abs(j) % 2)) + (layer % 2) * radius_m;
        const double y = deep * j + (layer % 2) * deep / 3;
        if (std::hypot(x, y) > reach) continue;
        spheres.push_back({.centre = {x + off(), y + off(), z}, .radius = radius_m});
      }
    }
  }
  return spheres;
}

inline Spheres moved(Spheres spheres, const dem::Vector& by) {
  for (dem::ClumpSphere& sphere : spheres) sphere.centre += by;
  return spheres;
}

// Tables.

/// The format of a table; its numbers are those of the spheres, in units of 1 / `per_m` metres.
struct TableLook {
  std::string header;          ///< verbatim, with its line end
  std::string order = "xyzr";  ///< d: diameter, i: its number, g: its grain, -: text
  std::string between = ",";
  double per_m = 1;
  bool has_decimal_comma = false;
};

inline std::string particle_table(const Spheres& spheres, const TableLook& look) {
  std::string text = look.header;
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const dem::ClumpSphere& sphere = spheres[k];
    std::string row;
    for (const char what : look.order) {
      const auto axis = std::string("xyz").find(what);
      std::string cell;
      if (axis != std::string::npos) {
        cell = fmt::format("{:.9f}", look.per_m * sphere.centre[static_cast<int>(axis)]);
      } else if (what == 'r' || what == 'd') {
        cell = fmt::format("{:.9f}", look.per_m * sphere.radius * (what == 'd' ? 2 : 1));
      } else if (what == 'i') {
        cell = fmt::format("{}", k + 1);
      } else if (what == 'g') {
        cell = fmt::format("{}", k / 2 + 1);
      } else {
        cell = "grain";
      }
      if (look.has_decimal_comma) std::ranges::replace(cell, '.', ',');
      row += (row.empty() ? "" : look.between) + cell;
    }
    text += row + '\n';
  }
  return text;
}

// Dumps.

struct DumpLook {
  std::string columns = "id type x y z radius";
  std::string before = "";  ///< sections above the others, "ITEM: UNITS\nsi\n"
};

/// One time step in a box from -1 to 1 m.
inline std::string dump_step(int step, const Spheres& spheres, const DumpLook& look = {}) {
  std::string text = look.before;
  text += fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 "
      "1\nITEM: ATOMS {}\n",
      step, spheres.size(), look.columns);
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const dem::ClumpSphere& sphere = spheres[k];
    std::string word, row;
    for (const char letter : look.columns + ' ') {
      if (letter != ' ') {
        word += letter;
        continue;
      }
      const auto axis = std::string("xyz").find(word.front());
      const double place = axis == std::string::npos ? 0 : sphere.centre[static_cast<int>(axis)];
      if (axis != std::string::npos && (word.size() == 1 || word.substr(1) == "u")) {
        row += fmt::format("{:.9g} ", place);
      } else if (axis != std::string::npos && (word.substr(1) == "s" || word.substr(1) == "su")) {
        row += fmt::format("{:.12g} ", (place + 1) / 2);
      } else if (word == "radius" || word == "diameter") {
        row += fmt::format("{:.9g} ", sphere.radius * (word == "diameter" ? 2 : 1));
      } else if (word == "mol" || word == "id_multisphere") {
        row += fmt::format("{} ", k / 2 + 1);
      } else {
        row += fmt::format("{} ", word == "id" ? k + 1 : std::size_t{1});
      }
      word.clear();
    }
    text += row + '\n';
  }
  return text;
}

// VTK.

template <typename Number>
void append_bytes(std::string& text, Number number, bool is_big) {
  std::array<char, sizeof(Number)> bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if (is_big) std::ranges::reverse(bytes);
  text.append(bytes.data(), bytes.size());
}

struct LegacyLook {
  bool is_binary = false;
  bool is_grid = false;    ///< UNSTRUCTURED_GRID
  bool has_field = false;  ///< radii in a FIELD, not as SCALARS
  bool is_double = false;
  bool has_offsets = false;  ///< cells as in version 5.1
};

inline std::string legacy_vtk(const Spheres& spheres, const LegacyLook& look) {
  const std::size_t n = spheres.size();
  const std::string type = look.is_double ? "double" : "float";
  std::string text = fmt::format("# vtk DataFile Version 3.0\na heap\n{}\nDATASET {}\n",
                                 look.is_binary ? "BINARY" : "ASCII",
                                 look.is_grid ? "UNSTRUCTURED_GRID" : "POLYDATA");
  const auto number = [&](double value) {
    if (!look.is_binary) {
      text += fmt::format("{:.9g}\n", value);
    } else if (look.is_double) {
      append_bytes(text, value, true);
    } else {
      append_bytes(text, static_cast<float>(value), true);
    }
  };
  const auto whole = [&](std::int32_t value) {
    if (look.is_binary) append_bytes(text, value, true);
    if (!look.is_binary) text += fmt::format("{} ", value);
  };
  text += fmt::format("POINTS {} {}\n", n, type);
  for (const dem::ClumpSphere& sphere : spheres) {
    for (int axis = 0; axis < 3; ++axis) number(sphere.centre[axis]);
  }
  const std::string cells = look.is_grid ? "CELLS" : "VERTICES";
  if (look.has_offsets) {
    text += fmt::format("\n{} {} {}\nOFFSETS vtktypeint32\n", cells, n + 1, n);
    for (std::size_t k = 0; k <= n; ++k) whole(static_cast<std::int32_t>(k));
    text += "\nCONNECTIVITY vtktypeint32\n";
    for (std::size_t k = 0; k < n; ++k) whole(static_cast<std::int32_t>(k));
  } else {
    text += fmt::format("\n{} {} {}\n", cells, n, 2 * n);
    for (std::size_t k = 0; k < n; ++k) {
      whole(1);
      whole(static_cast<std::int32_t>(k));
    }
  }
  if (look.is_grid) {
    text += fmt::format("\nCELL_TYPES {}\n", n);
    for (std::size_t k = 0; k < n; ++k) whole(1);
  }
  text += fmt::format("\nPOINT_DATA {}\nVECTORS v {}\n", n, type);
  for (std::size_t k = 0; k < 3 * n; ++k) number(0);
  text += look.has_field ? fmt::format("\nFIELD FieldData 1\nradius 1 {} {}\n", n, type)
                         : fmt::format("\nSCALARS radius {} 1\nLOOKUP_TABLE default\n", type);
  for (const dem::ClumpSphere& sphere : spheres) number(sphere.radius);
  return text + '\n';
}

struct XmlLook {
  enum class Form { ascii, binary, raw, base64 };
  Form form = Form::ascii;  ///< the last two are appended
  bool is_packed = false;
  bool has_long_header = false;
  bool is_polydata = false;
};

/// Blocks of a file's bytes, each compressed separately.
inline std::vector<std::string> packed_blocks(const std::string& bytes, std::size_t block_bytes) {
  std::vector<std::string> blocks;
  for (std::size_t at = 0; at < bytes.size(); at += block_bytes) {
    const std::string block = bytes.substr(at, block_bytes);
    uLongf size = compressBound(block.size());
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size,
             reinterpret_cast<const Bytef*>(block.data()), block.size());
    packed.resize(size);
    blocks.push_back(packed);
  }
  return blocks;
}

inline std::string xml_vtk(const Spheres& spheres, const XmlLook& look) {
  using enum XmlLook::Form;
  std::string appended;
  const auto text_of = [](const std::string& bytes) {
    return base::base64_of(std::as_bytes(std::span(bytes)));
  };
  const auto array = [&](const std::string& name, int parts, const std::vector<double>& values) {
    std::string head = fmt::format(
        "<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" ", name, parts);
    if (look.form == ascii) {
      std::string words;
      for (const double value : values) words += fmt::format("{:.9g} ", value);
      return head + "format=\"ascii\">" + words + "</DataArray>\n";
    }
    std::string bytes, header;
    for (const double value : values) append_bytes(bytes, value, false);
    const auto count = [&](std::size_t number) {
      if (look.has_long_header) append_bytes(header, static_cast<std::uint64_t>(number), false);
      if (!look.has_long_header) append_bytes(header, static_cast<std::uint32_t>(number), false);
    };
    std::string encoded;
    if (look.is_packed) {
      constexpr std::size_t kBlock = 1 << 12;
      const std::vector<std::string> blocks = packed_blocks(bytes, kBlock);
      count(blocks.size());
      count(kBlock);
      count(bytes.size() % kBlock);
      std::string body;
      for (const std::string& block : blocks) count(block.size());
      for (const std::string& block : blocks) body += block;
      encoded = look.form == raw ? header + body : text_of(header) + text_of(body);
    } else {
      count(bytes.size());
      encoded = look.form == raw ? header + bytes : text_of(header + bytes);
    }
    if (look.form == binary) return head + "format=\"binary\">\n" + encoded + "\n</DataArray>\n";
    head += fmt::format("format=\"appended\" offset=\"{}\"/>\n", appended.size());
    appended += encoded;
    return head;
  };
  std::vector<double> places, radii;
  for (const dem::ClumpSphere& sphere : spheres) {
    for (int axis = 0; axis < 3; ++axis) places.push_back(sphere.centre[axis]);
    radii.push_back(sphere.radius);
  }
  const std::string type = look.is_polydata ? "PolyData" : "UnstructuredGrid";
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"{1}\"{2}>\n<{0}>\n<Piece NumberOfPoints=\"{3}\" NumberOfCells=\"0\">\n",
      type, look.has_long_header ? "UInt64" : "UInt32",
      look.is_packed ? " compressor=\"vtkZLibDataCompressor\"" : "", spheres.size());
  text += "<PointData>\n" + array("velocity", 3, places) + array("radius", 1, radii) +
          "</PointData>\n<Points>\n" + array("Points", 3, places) + "</Points>\n";
  text += fmt::format("</Piece>\n</{}>\n", type);
  if (look.form == raw || look.form == base64) {
    text += fmt::format("<AppendedData encoding=\"{}\">\n_", look.form == raw ? "raw" : "base64") +
            appended + "\n</AppendedData>\n";
  }
  return text + "</VTKFile>\n";
}

// EDEM's exports.

struct EdemLook {
  bool has_columns = false;
  std::string between = ",";
  std::string size = "Particle Radius";
  std::string unit = "";  ///< " (mm)", after each name
  double per_m = 1;
};

inline std::string edem_moment(const std::string& time, const Spheres& spheres,
                               const EdemLook& look) {
  const std::vector<std::string> names = {"Particle ID", "Particle Position X",
                                          "Particle Position Y", "Particle Position Z", look.size};
  const auto value = [&](std::size_t query, std::size_t k) {
    const dem::ClumpSphere& sphere = spheres[k];
    if (query == 0) return fmt::format("{}", k + 1);
    const double size = sphere.radius * (look.size == "Particle Diameter" ? 2 : 1);
    const double length = query == 4 ? size : sphere.centre[static_cast<int>(query) - 1];
    return fmt::format("{:.9f}", look.per_m * length);
  };
  const auto name = [&](std::size_t query) {
    const std::string unit = query == 0 ? "" : look.unit;
    return fmt::format("Q{:02} : {}{}:", query + 1, names[query], unit);
  };
  std::string text = fmt::format("TIME:{}{}\n", look.between, time);
  if (look.has_columns) {
    for (std::size_t q = 0; q < names.size(); ++q) text += (q > 0 ? look.between : "") + name(q);
    text += '\n';
    for (std::size_t k = 0; k < spheres.size(); ++k) {
      for (std::size_t q = 0; q < names.size(); ++q) text += look.between + value(q, k);
      text += '\n';
    }
    return text;
  }
  for (std::size_t q = 0; q < names.size(); ++q) {
    text += name(q);
    for (std::size_t k = 0; k < spheres.size(); ++k) text += look.between + value(q, k);
    text += '\n';
  }
  return text + '\n';
}

}  // namespace repose::testing
