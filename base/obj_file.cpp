#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/polygon_file.h"
#include "base/text.h"

namespace repose::base {

namespace {

/// The whole word as a number.
template <typename Number>
bool read(std::string_view word, Number& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const auto [stopped_at, error] = std::from_chars(word.data(), end, number);
  return error == std::errc{} && stopped_at == end;
}

/// Reads line by line.
class ObjReader {
 public:
  explicit ObjReader(std::string_view bytes) : rest_(bytes) {}

  PolygonSurface read_all() {
    while (!rest_.empty()) {
      joined_.clear();
      std::string_view line = take_line();
      const std::string_view keyword = take_word(line);
      if (keyword == "v") read_corner(line);
      if (keyword == "f") read_face(line);
    }
    check_faces();
    return std::move(surface_);
  }

 private:
  [[noreturn]] static void wrong(std::size_t line, const std::string& what) {
    throw InputError({.where = fmt::format("line {}", line), .value = what});
  }

  std::string_view take_physical_line() {
    ++line_;
    const std::size_t length = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, length);
    rest_.remove_prefix(std::min(length + 1, rest_.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  /// A backslash at the end continues the line on the next one.
  std::string_view take_line() {
    std::string_view line = take_physical_line();
    if (!line.ends_with('\\')) return line;
    for (; line.ends_with('\\'); line = take_physical_line()) {
      joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
    }
    joined_.append(line);
    return joined_;
  }

  /// A weight or colours may follow; they do not affect the position.
  void read_corner(std::string_view line) {
    Corner& corner = surface_.corners.emplace_back();
    for (double& coordinate : corner) {
      const std::string_view word = take_word(line);
      if (!read(word, coordinate)) {
        wrong(line_, "a corner must have three coordinates, all numbers");
      }
    }
  }

  /// "7", "7/2" or "7//4": only the first number is a vertex; a negative one counts back from here.
  void read_face(std::string_view line) {
    std::vector<int> face;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      std::int64_t number = 0;
      const bool is_read = read(word.substr(0, word.find('/')), number);
      const auto corners = static_cast<std::int64_t>(surface_.corners.size());
      const std::int64_t corner = number < 0 ? corners + number : number - 1;
      if (!is_read || corner < 0 || corner >= std::numeric_limits<int>::max()) {
        wrong(line_, "a face must name its corners by numbers that there are, from 1 on");
      }
      face.push_back(static_cast<int>(corner));
    }
    if (face.size() < 3) return;
    surface_.faces.push_back(std::move(face));
    lines_of_faces_.push_back(line_);
  }

  /// A face may precede its vertices.
  void check_faces() const {
    const auto corners = static_cast<int>(surface_.corners.size());
    for (std::size_t i = 0; i < surface_.faces.size(); ++i) {
      for (const int corner : surface_.faces[i]) {
        if (corner < corners) continue;
        wrong(lines_of_faces_[i], fmt::format("a face names corner {} of {}", corner + 1, corners));
      }
    }
  }

  std::string_view rest_;
  std::string joined_;
  std::size_t line_ = 0;
  PolygonSurface surface_;
  std::vector<std::size_t> lines_of_faces_;
};

}  // namespace

PolygonSurface parse_obj(std::string_view bytes) { return ObjReader(bytes).read_all(); }

}  // namespace repose::base
