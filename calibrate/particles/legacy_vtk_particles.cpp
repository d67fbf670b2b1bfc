#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/particles/particle_columns.h"
#include "calibrate/particles/text_scanner.h"

/// Points with values in VTK's legacy format, text or binary.
/// Source: VTK User's Guide, "VTK File Formats", simple legacy formats, versions 1.0 to 5.1.
namespace repose::calibrate {
namespace {

/// Number types of the binary form, big-endian.
enum class NumberKind { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

std::optional<NumberKind> kind_named(std::string_view name) {
  using enum NumberKind;
  constexpr std::array<std::pair<std::string_view, NumberKind>, 18> kKinds = {
      {{"char", i8},
       {"unsigned_char", u8},
       {"short", i16},
       {"unsigned_short", u16},
       {"int", i32},
       {"unsigned_int", u32},
       {"long", i64},
       {"unsigned_long", u64},
       {"float", f32},
       {"double", f64},
       {"vtkidtype", i32},
       {"vtktypeint64", i64},
       {"vtktypeuint64", u64},
       {"vtktypeint32", i32},
       {"vtktypeuint32", u32},
       {"vtktypeint8", i8},
       {"vtktypeuint8", u8},
       {"vtktypeint16", i16}}};
  const auto found =
      std::ranges::find(kKinds, name, &std::pair<std::string_view, NumberKind>::first);
  return found == kKinds.end() ? std::nullopt : std::optional(found->second);
}

std::size_t bytes_of(NumberKind kind) {
  using enum NumberKind;
  switch (kind) {
    case i8:
    case u8:
      return 1;
    case i16:
    case u16:
      return 2;
    case i32:
    case u32:
    case f32:
      return 4;
    case i64:
    case u64:
    case f64:
      break;
  }
  return 8;
}

template <typename Number>
double big_endian(const char* at) {
  std::array<char, sizeof(Number)> bytes{};
  std::reverse_copy(at, at + sizeof(Number), bytes.begin());
  return static_cast<double>(std::bit_cast<Number>(bytes));
}

double number_at(const char* at, NumberKind kind) {
  using enum NumberKind;
  switch (kind) {
    case i8:
      return big_endian<std::int8_t>(at);
    case u8:
      return big_endian<std::uint8_t>(at);
    case i16:
      return big_endian<std::int16_t>(at);
    case u16:
      return big_endian<std::uint16_t>(at);
    case i32:
      return big_endian<std::int32_t>(at);
    case u32:
      return big_endian<std::uint32_t>(at);
    case i64:
      return big_endian<std::int64_t>(at);
    case u64:
      return big_endian<std::uint64_t>(at);
    case f32:
      return big_endian<float>(at);
    case f64:
      break;
  }
  return big_endian<double>(at);
}

class LegacyReader {
 public:
  LegacyReader(const std::string& file, std::string_view text)
      : file_(file), text_(text), scanner_(text) {}

  ParticleColumns read() {
    scanner_.line();  // # vtk DataFile Version 3.0
    scanner_.line();  // its title
    const std::string form = small(scanner_.word());
    is_binary_ = form == "binary";
    if (!is_binary_ && form != "ascii") refuse(fmt::format("its third line is \"{}\"", form));
    scanner_.line();
    found_ = {.file = file_, .format = "VTK, legacy", .columns = {}, .names = {}};
    for (std::string word = small(scanner_.word()); !word.empty(); word = small(scanner_.word())) {
      read_section(word);
    }
    if (!points_) refuse("it has no POINTS");
    return std::move(found_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw base::InputError({.where = file_,
                            .value = fmt::format("no VTK file that can be read: {}", what),
                            .rule = "legacy VTK with points and their radius",
                            .fix = "write it again, or as .vtu or CSV, with ParaView say."});
  }

  static std::string small(std::string_view word) {
    std::string letters(word);
    for (char& letter : letters) {
      letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
    return letters;
  }

  std::size_t count(const char* what) {
    const std::string_view word = scanner_.word();
    const auto value = TextScanner::whole<std::size_t>(word);
    if (!value || *value > text_.size()) refuse(fmt::format("{} of \"{}\"", what, word));
    return *value;
  }

  NumberKind kind() {
    const std::string name = small(scanner_.word());
    const auto known = kind_named(name);
    if (!known) refuse(fmt::format("values of type \"{}\"", name));
    return *known;
  }

  void read_section(const std::string& word) {
    constexpr std::array<std::string_view, 6> kCells = {"vertices",        "lines", "polygons",
                                                        "triangle_strips", "cells", "strips"};
    if (word == "dataset") {
      const std::string_view set = scanner_.word();
      if (small(set) != "polydata" && small(set) != "unstructured_grid") {
        refuse(fmt::format("DATASET {}, not POLYDATA or UNSTRUCTURED_GRID", set));
      }
    } else if (word == "points") {
      points_ = count("POINTS");
      take_columns(numbers(3 * *points_, kind(), "POINTS"), 3, "points");
    } else if (std::ranges::find(kCells, word) != kCells.end()) {
      skip_cells();
    } else if (word == "cell_types") {
      const std::size_t cells = count("CELL_TYPES");
      numbers(cells, NumberKind::i32, "CELL_TYPES");
    } else if (word == "point_data") {
      of_points_ = true;
      values_ = count("POINT_DATA");
      if (points_ && values_ != *points_) refuse("POINT_DATA is not of as many as POINTS");
    } else if (word == "cell_data") {
      of_points_ = false;
      values_ = count("CELL_DATA");
    } else if (word == "metadata") {
      while (!scanner_.is_at_end() && !scanner_.line().empty()) {
      }
    } else {
      read_values(word);
    }
  }

  void read_values(const std::string& word) {
    if (word == "scalars") {
      const std::string name(scanner_.word());
      const NumberKind of = kind();
      TextScanner rest(scanner_.line());
      const auto components = TextScanner::whole<std::size_t>(rest.word()).value_or(1);
      const std::size_t before = scanner_.at();
      if (small(scanner_.word()) == "lookup_table") {
        scanner_.word();
      } else {
        scanner_.move_to(before - 1);  // the end of the line, after which the bytes begin
      }
      take_array(name, components, values_, of);
    } else if (word == "vectors" || word == "normals") {
      const std::string name(scanner_.word());
      take_array(name, 3, values_, kind());
    } else if (word == "tensors") {
      const std::string name(scanner_.word());
      take_array(name, 9, values_, kind());
    } else if (word == "lookup_table") {
      scanner_.word();
      numbers(4 * count("LOOKUP_TABLE"), is_binary_ ? NumberKind::u8 : NumberKind::f32,
              "LOOKUP_TABLE");
    } else if (word == "field") {
      scanner_.word();
      read_field(count("FIELD"));
    } else {
      refuse(fmt::format("\"{}\" where a section should begin", word.substr(0, 40)));
    }
  }

  void read_field(std::size_t arrays) {
    for (std::size_t k = 0; k < arrays; ++k) {
      std::string name(scanner_.word());
      while (small(name) == "metadata") {
        while (!scanner_.is_at_end() && !scanner_.line().empty()) {
        }
        name = scanner_.word();
      }
      const std::size_t components = count("FIELD");
      const std::size_t tuples = count("FIELD");
      const std::string type = small(scanner_.word());
      if (type == "string") {
        scanner_.line();
        for (std::size_t j = 0; j < components * tuples; ++j) scanner_.line();
        continue;
      }
      const auto known = kind_named(type);
      if (!known) refuse(fmt::format("values of type \"{}\"", type));
      take_array(name, components, tuples, *known);
    }
  }

  /// Cells in either form: one list with counts, or offsets and connectivity.
  void skip_cells() {
    const std::size_t cells = count("cells"), size = count("cells");
    const std::size_t before = scanner_.at();
    if (small(scanner_.word()) != "offsets") {
      scanner_.move_to(before);
      numbers(size, NumberKind::i32, "cells");
      return;
    }
    numbers(cells, kind(), "OFFSETS");
    if (small(scanner_.word()) != "connectivity") refuse("OFFSETS without CONNECTIVITY");
    numbers(size, kind(), "CONNECTIVITY");
  }

  std::vector<double> numbers(std::size_t wanted, NumberKind of, const char* what) {
    std::vector<double> values;
    values.reserve(std::min(wanted, text_.size()));
    if (!is_binary_) {
      for (std::size_t k = 0; k < wanted; ++k) {
        const std::string_view word = scanner_.word();
        const auto value = TextScanner::number(word);
        if (!value) refuse_cut(what, k, wanted, word);
        values.push_back(*value);
      }
      return values;
    }
    scanner_.line();
    const std::size_t size = bytes_of(of);
    if ((text_.size() - scanner_.at()) / size < wanted) {
      refuse_cut(what, (text_.size() - scanner_.at()) / size, wanted, {});
    }
    for (std::size_t k = 0; k < wanted; ++k) {
      values.push_back(number_at(text_.data() + scanner_.at() + k * size, of));
    }
    scanner_.move_to(scanner_.at() + wanted * size);
    return values;
  }

  [[noreturn]] void refuse_cut(const char* what, std::size_t has, std::size_t wanted,
                               std::string_view word) const {
    if (!word.empty()) {
      refuse(fmt::format("{}: \"{}\" is no number", what, word.substr(0, 40)));
    }
    throw base::InputError(
        {.where = file_,
         .value = fmt::format("is cut short: {} has {} of {} numbers", what, has, wanted),
         .fix = "copy it again, or let the run write it to its end."});
  }

  void take_array(const std::string& name, std::size_t components, std::size_t tuples,
                  NumberKind of) {
    std::vector<double> values = numbers(components * tuples, of, name.c_str());
    if (!of_points_ || !points_ || tuples != *points_) return;
    take_columns(values, components, name);
  }

  void take_columns(const std::vector<double>& values, std::size_t components,
                    const std::string& name) {
    for (std::size_t part = 0; part < components; ++part) {
      const std::string column = components == 1 ? name : fmt::format("{}:{}", name, part);
      found_.names.push_back(column);
      if (!is_of_use(column)) continue;
      // Positions come from the points; another vector array with such a name is something else.
      if (name != "points" && components == 3) continue;
      ParticleColumn taken{.name = column, .values = {}};
      taken.values.reserve(values.size() / components);
      for (std::size_t k = part; k < values.size(); k += components) {
        taken.values.push_back(values[k]);
      }
      found_.columns.push_back(std::move(taken));
    }
  }

  const std::string& file_;
  std::string_view text_;
  TextScanner scanner_;
  bool is_binary_ = false;
  bool of_points_ = false;
  std::optional<std::size_t> points_;
  std::size_t values_ = 0;  ///< tuples of the section's arrays
  ParticleColumns found_;
};

}  // namespace

ParticleColumns columns_in_legacy_vtk(const std::string& file, std::string_view text,
                                      const ParticleReading&) {
  return LegacyReader(file, text).read();
}

}  // namespace repose::calibrate
