#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>
#include <zlib.h>

#include "base/base64.h"
#include "base/input_error.h"
#include "calibrate/particles/particle_columns.h"
#include "calibrate/particles/text_scanner.h"

/// Points with values in VTK's XML formats: .vtu and .vtp, with numbers as text, in base64 or
/// appended, plain or compressed by zlib.
/// Source: VTK documentation, "VTK XML Formats".
namespace repose::calibrate {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::size_t kMostBytes = std::size_t{1} << 32;

class XmlReader {
 public:
  XmlReader(const std::string& file, std::string_view text) : file_(file), text_(text) {}

  ParticleColumns read() {
    parse();
    const pugi::xml_node root = document_.child("VTKFile");
    const std::string type = root.attribute("type").value();
    if (type != "UnstructuredGrid" && type != "PolyData") {
      refuse(root ? fmt::format("it holds {}", type.empty() ? "nothing that is named" : type)
                  : std::string("it is no file of VTK"));
    }
    if (std::string_view(root.attribute("byte_order").value()) == "BigEndian") {
      refuse("its bytes are in the order of big-endian machines");
    }
    header_is_long_ = std::string_view(root.attribute("header_type").value()) == "UInt64";
    const std::string compressor = root.attribute("compressor").value();
    is_compressed_ = !compressor.empty();
    if (is_compressed_ && compressor != "vtkZLibDataCompressor") {
      refuse(fmt::format("it is compressed by {}", compressor));
    }
    found_ = {.file = file_, .format = "VTK, XML", .columns = {}, .names = {}};
    bool is_first = true;
    for (const pugi::xml_node& piece : root.child(type.c_str()).children("Piece")) {
      read_piece(piece, std::exchange(is_first, false));
    }
    if (is_first) refuse("it has no points");
    return std::move(found_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw base::InputError(
        {.where = file_,
         .value = fmt::format("no VTK file that can be read: {}", what),
         .rule = "a whole .vtu or .vtp, little-endian, plain or compressed by zlib",
         .fix = "copy it again, or write it with other settings or as CSV, with ParaView say."});
  }

  /// Appended raw bytes are not XML, so they are taken out first.
  void parse() {
    const std::size_t from = text_.find("<AppendedData");
    std::string xml(text_.substr(0, from));
    if (from != text_.npos) {
      const std::size_t open = text_.find('>', from);
      const std::size_t mark = text_.find('_', open == text_.npos ? from : open);
      const std::size_t end = text_.rfind("</AppendedData>");
      if (open == text_.npos || mark == text_.npos || end == text_.npos || end < mark) {
        refuse("it is cut short within what is appended");
      }
      is_raw_ = text_.substr(from, open - from).find("\"raw\"") != text_.npos;
      appended_ = text_.substr(mark + 1, end - mark - 1);
      xml += "</VTKFile>";
    }
    const pugi::xml_parse_result parsed = document_.load_buffer(xml.data(), xml.size());
    if (!parsed) refuse(fmt::format("{} after {} bytes", parsed.description(), parsed.offset));
  }

  void read_piece(const pugi::xml_node& piece, bool is_first) {
    const auto count = TextScanner::whole<std::size_t>(piece.attribute("NumberOfPoints").value());
    if (!count || *count > text_.size()) refuse("NumberOfPoints is no number that can be");
    std::size_t next = 0;
    const auto add = [&](const std::string& name, std::vector<double> values) {
      if (is_first) {
        found_.columns.push_back({.name = name, .values = std::move(values)});
        return;
      }
      if (next >= found_.columns.size() || found_.columns[next].name != name) {
        refuse("its pieces have different arrays");
      }
      std::vector<double>& all = found_.columns[next++].values;
      all.insert(all.end(), values.begin(), values.end());
    };
    const pugi::xml_node points = piece.child("Points").child("DataArray");
    if (*count > 0 && !points) refuse("it has no <Points>");
    const std::vector<double> places =
        *count > 0 ? array(points, 3 * *count) : std::vector<double>();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (std::size_t k = axis; k < places.size(); k += 3) values.push_back(places[k]);
      if (is_first) found_.names.push_back(fmt::format("points:{}", axis));
      add(fmt::format("points:{}", axis), std::move(values));
    }
    for (const pugi::xml_node& one : piece.child("PointData").children("DataArray")) {
      const std::string name = one.attribute("Name").value();
      if (is_first) found_.names.push_back(name);
      const auto components = one.attribute("NumberOfComponents").as_uint(1);
      if (components != 1 || !is_of_use(name)) continue;
      add(name, *count > 0 ? array(one, *count) : std::vector<double>());
    }
  }

  std::vector<double> array(const pugi::xml_node& node, std::size_t wanted) const {
    const std::string name = node.attribute("Name").value();
    const std::string format = node.attribute("format").value();
    if (format == "ascii") {
      std::vector<double> values;
      TextScanner words(node.child_value());
      for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
        const auto value = TextScanner::number(word);
        if (!value) refuse(fmt::format("{}: \"{}\" is no number", name, word.substr(0, 40)));
        values.push_back(*value);
      }
      return checked(std::move(values), wanted, name);
    }
    Bytes bytes;
    if (format == "appended") {
      const auto offset = TextScanner::whole<std::size_t>(node.attribute("offset").value());
      if (!offset || *offset >= appended_.size()) refuse(fmt::format("{} is not appended", name));
      bytes = payload(appended_.substr(*offset), is_raw_, name);
    } else if (format == "binary") {
      bytes = payload(node.child_value(), false, name);
    } else {
      refuse(fmt::format("{}: format \"{}\"", name, format));
    }
    return checked(numbers_in(bytes, node.attribute("type").value(), name), wanted, name);
  }

  std::vector<double> checked(std::vector<double> values, std::size_t wanted,
                              const std::string& name) const {
    if (values.size() == wanted) return values;
    refuse(fmt::format("{} has {} of {} numbers", name, values.size(), wanted));
  }

  template <typename Number>
  static std::vector<double> as_doubles(const Bytes& bytes) {
    std::vector<double> values(bytes.size() / sizeof(Number));
    for (std::size_t k = 0; k < values.size(); ++k) {
      Number number;
      std::memcpy(&number, bytes.data() + k * sizeof(Number), sizeof(Number));
      values[k] = static_cast<double>(number);
    }
    return values;
  }

  std::vector<double> numbers_in(const Bytes& bytes, std::string_view type,
                                 const std::string& name) const {
    if (type == "Float32") return as_doubles<float>(bytes);
    if (type == "Float64") return as_doubles<double>(bytes);
    if (type == "Int8") return as_doubles<std::int8_t>(bytes);
    if (type == "UInt8") return as_doubles<std::uint8_t>(bytes);
    if (type == "Int16") return as_doubles<std::int16_t>(bytes);
    if (type == "UInt16") return as_doubles<std::uint16_t>(bytes);
    if (type == "Int32") return as_doubles<std::int32_t>(bytes);
    if (type == "UInt32") return as_doubles<std::uint32_t>(bytes);
    if (type == "Int64") return as_doubles<std::int64_t>(bytes);
    if (type == "UInt64") return as_doubles<std::uint64_t>(bytes);
    refuse(fmt::format("{}: values of type \"{}\"", name, type));
  }

  /// A stream of bytes, raw or decoded from base64, where each part is encoded separately.
  class Stream {
   public:
    Stream(std::string_view text, bool is_raw) : text_(text), is_raw_(is_raw) {
      const std::size_t from = text_.find_first_not_of(" \t\r\n");
      if (!is_raw_) text_.remove_prefix(from == text_.npos ? text_.size() : from);
    }

    /// std::nullopt if there are not enough.
    std::optional<Bytes> take(std::size_t count) {
      if (count > kMostBytes) return std::nullopt;
      const std::size_t size = is_raw_ ? count : (count + 2) / 3 * 4;
      if (text_.size() < size) return std::nullopt;
      const std::string_view part = text_.substr(0, size);
      text_.remove_prefix(size);
      if (is_raw_) {
        const auto* at = reinterpret_cast<const std::byte*>(part.data());
        return Bytes(at, at + count);
      }
      auto bytes = base::bytes_of_base64(part);
      if (!bytes || bytes->size() < count) return std::nullopt;
      bytes->resize(count);
      return bytes;
    }

   private:
    std::string_view text_;
    bool is_raw_;
  };

  std::uint64_t header_number(const Bytes& bytes, std::size_t place) const {
    const std::size_t size = header_is_long_ ? sizeof(std::uint64_t) : sizeof(std::uint32_t);
    std::uint64_t number = 0;  // little-endian, like the machines this runs on
    static_assert(std::endian::native == std::endian::little);
    std::memcpy(&number, bytes.data() + place * size, size);
    return number;
  }

  /// An array's bytes after its header.
  Bytes payload(std::string_view text, bool is_raw, const std::string& name) const {
    const std::size_t size = header_is_long_ ? sizeof(std::uint64_t) : sizeof(std::uint32_t);
    const auto cut = [&]() { refuse(fmt::format("{} is cut short, or no base64", name)); };
    if (!is_compressed_) {
      // Header and numbers are encoded together.
      const auto header = Stream(text, is_raw).take(size);
      if (!header) cut();
      const std::uint64_t count = header_number(*header, 0);
      if (count > text.size()) cut();
      auto all = Stream(text, is_raw).take(size + count);
      if (!all) cut();
      all->erase(all->begin(), all->begin() + static_cast<std::ptrdiff_t>(size));
      return *std::move(all);
    }
    const auto first = Stream(text, is_raw).take(3 * size);
    if (!first) cut();
    const std::uint64_t blocks = header_number(*first, 0);
    if (blocks > text.size()) cut();
    Stream stream(text, is_raw);
    const auto header = stream.take((3 + blocks) * size);
    if (!header) cut();
    std::size_t packed = 0;
    for (std::uint64_t k = 0; k < blocks; ++k) {
      const std::uint64_t block = header_number(*header, 3 + k);
      if (block > text.size()) cut();
      packed += block;
    }
    const auto body = stream.take(packed);
    if (!body) cut();
    return unpacked(*header, *body, name);
  }

  Bytes unpacked(const Bytes& header, const Bytes& body, const std::string& name) const {
    const std::uint64_t blocks = header_number(header, 0);
    const std::uint64_t block = header_number(header, 1), last = header_number(header, 2);
    Bytes bytes;
    std::size_t at = 0;
    for (std::uint64_t k = 0; k < blocks; ++k) {
      const std::uint64_t full = k + 1 == blocks && last > 0 ? last : block;
      const std::uint64_t packed = header_number(header, 3 + k);
      // zlib expands a byte to at most 1032 bytes (its own documentation, "Maximum Compression").
      constexpr std::uint64_t kMostFold = 1032;
      if (packed > body.size() - at || full > kMostFold * packed ||
          bytes.size() + full > kMostBytes) {
        refuse(fmt::format("{} is larger than can be", name));
      }
      const std::size_t before = bytes.size();
      bytes.resize(before + full);
      uLongf written = full;
      const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data() + before), &written,
                                    reinterpret_cast<const Bytef*>(body.data() + at), packed);
      if (status != Z_OK || written != full) {
        refuse(fmt::format("{} cannot be unpacked", name));
      }
      at += packed;
    }
    return bytes;
  }

  const std::string& file_;
  std::string_view text_;
  pugi::xml_document document_;
  std::string_view appended_;
  bool is_raw_ = false;
  bool header_is_long_ = false;
  bool is_compressed_ = false;
  ParticleColumns found_;
};

}  // namespace

ParticleColumns columns_in_xml_vtk(const std::string& file, std::string_view text,
                                   const ParticleReading&) {
  return XmlReader(file, text).read();
}

}  // namespace repose::calibrate
