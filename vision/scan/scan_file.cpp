#include "vision/scan/scan_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/text.h"
#include "vision/scan/glb_file.h"

namespace repose::vision {

namespace {

constexpr std::size_t kMaxPoints = 40'000'000;
constexpr double kLargestCoordinate = 1e9;
// Number of points spread over a surface.
constexpr std::size_t kPerTriangle = 2, kFewestOnSurface = 2'000'000, kMostOnSurface = 10'000'000;

static_assert(std::endian::native == std::endian::little, "STL files are little-endian");

std::string lower_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

[[noreturn]] void wrong(const std::string& what) { throw base::InputError({.value = what}); }

void add_triangle(TriangleSoup& soup, const std::array<base::Corner, 3>& corners) {
  const auto first = static_cast<std::uint32_t>(soup.corners.size());
  soup.corners.insert(soup.corners.end(), corners.begin(), corners.end());
  soup.triangles.push_back({first, first + 1, first + 2});
}

/// 80 bytes of text, the count, and 50 bytes per triangle: its normal, three vertices, two more.
TriangleSoup parse_binary_stl(std::string_view bytes) {
  constexpr std::size_t kHead = 84, kEach = 50, kNormal = 12, kPlace = 12;
  if (bytes.size() < kHead) wrong("the file ends within its head");
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHead - sizeof count, sizeof count);
  if ((bytes.size() - kHead) / kEach < count) {
    wrong(fmt::format("the file ends too soon: {} triangles of {} are there",
                      (bytes.size() - kHead) / kEach, count));
  }
  TriangleSoup soup;
  for (std::size_t k = 0; k < count; ++k) {
    std::array<base::Corner, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<float, 3> place{};
      std::memcpy(place.data(), bytes.data() + kHead + k * kEach + kNormal + i * kPlace, kPlace);
      std::copy(place.begin(), place.end(), corners[i].begin());
    }
    add_triangle(soup, corners);
  }
  return soup;
}

double next_number(std::string_view& rest) {
  std::string_view word = base::take_word(rest);
  if (word.starts_with('+')) word.remove_prefix(1);
  double number = 0;
  const char* const end = word.data() + word.size();
  const auto [stopped_at, error] = std::from_chars(word.data(), end, number);
  if (word.empty()) wrong("the file ends within a corner");
  if (error == std::errc::invalid_argument || stopped_at != end) {
    wrong(fmt::format("\"{}\" stands where a number must", std::string(word.substr(0, 20))));
  }
  return number;
}

TriangleSoup parse_text_stl(std::string_view rest) {
  TriangleSoup soup;
  std::array<base::Corner, 3> corners{};
  std::size_t read = 0;
  bool is_whole = false;
  for (std::string_view word = base::take_word(rest); !word.empty(); word = base::take_word(rest)) {
    is_whole = word == "endsolid";
    if (is_whole) rest.remove_prefix(std::min(rest.find('\n'), rest.size()));
    if (word == "facet") read = 0;
    if (word == "endfacet" && read != 3) wrong("a facet has not three corners");
    if (word != "vertex") continue;
    if (read == 3) wrong("a facet has more than three corners");
    for (double& coordinate : corners[read]) coordinate = next_number(rest);
    if (++read == 3) add_triangle(soup, corners);
  }
  if (!is_whole) wrong("the file ends before its \"endsolid\"");
  return soup;
}

/// Text files begin with "solid"; so do the headers of some binary ones, which are recognised by
/// their size.
TriangleSoup parse_stl(std::string_view bytes) {
  constexpr std::size_t kHead = 84, kEach = 50;
  std::uint32_t count = 0;
  if (bytes.size() >= kHead) std::memcpy(&count, bytes.data() + kHead - sizeof count, sizeof count);
  const bool has_binary_size = bytes.size() == kHead + kEach * std::size_t{count};
  const bool is_text = bytes.starts_with("solid") && !has_binary_size;
  return is_text ? parse_text_stl(bytes) : parse_binary_stl(bytes);
}

/// Polygons are split into fans of triangles: they are flat, or nearly so.
TriangleSoup soup_of(base::PolygonSurface surface) {
  TriangleSoup soup{.corners = std::move(surface.corners), .triangles = {}};
  for (const std::vector<int>& face : surface.faces) {
    for (std::size_t k = 2; k < face.size(); ++k) {
      soup.triangles.push_back({static_cast<std::uint32_t>(face[0]),
                                static_cast<std::uint32_t>(face[k - 1]),
                                static_cast<std::uint32_t>(face[k])});
    }
  }
  return soup;
}

bool is_finite(const base::Corner& corner) {
  return std::all_of(corner.begin(), corner.end(),
                     [](double coordinate) { return std::abs(coordinate) <= kLargestCoordinate; });
}

/// Points all over the triangles, in proportion to their area: a sequence that fills a square
/// evenly, folded into the triangle. Rows of points would miss the tips of slivers. Source of the
/// sequence: Roberts (2018), The unreasonable effectiveness of quasirandom sequences (R2: multiples
/// of 1/g and 1/g^2, g^3 = g + 1).
std::vector<base::Corner> spread_over(const TriangleSoup& soup) {
  constexpr double kG = 1.32471795724474602596;
  const auto at = [&](const std::array<std::uint32_t, 3>& triangle, std::size_t k) {
    return Eigen::Vector3d::Map(soup.corners[triangle[k]].data());
  };
  double area = 0;
  for (const auto& t : soup.triangles) {
    area += (at(t, 1) - at(t, 0)).cross(at(t, 2) - at(t, 0)).norm() / 2;
  }
  std::vector<base::Corner> points;
  if (!(area > 0)) return points;
  const std::size_t count =
      std::clamp(kPerTriangle * soup.triangles.size(), kFewestOnSurface, kMostOnSurface);
  points.reserve(count + 1);
  double due = 0, a = .5, b = .5;
  for (const auto& t : soup.triangles) {
    const Eigen::Vector3d one = at(t, 1) - at(t, 0), other = at(t, 2) - at(t, 0);
    due += one.cross(other).norm() / 2 / area * static_cast<double>(count);
    for (; due >= 1; --due) {
      a = std::fmod(a + 1 / kG, 1.0);
      b = std::fmod(b + 1 / (kG * kG), 1.0);
      const bool is_folded = a + b > 1;
      const Eigen::Vector3d place = Eigen::Vector3d(at(t, 0)) + (is_folded ? 1 - a : a) * one +
                                    (is_folded ? 1 - b : b) * other;
      points.push_back({place.x(), place.y(), place.z()});
    }
  }
  return points;
}

TriangleSoup parsed(std::string_view bytes, const std::string& ending) {
  if (is_glb(bytes)) return parse_glb(bytes);
  if (bytes.starts_with("ply")) return soup_of(base::parse_ply(bytes));
  if (ending == ".obj") return soup_of(base::parse_obj(bytes));
  if (ending == ".stl") return parse_stl(bytes);
  wrong(fmt::format("it does not begin as a {} file does", ending.empty() ? "scan" : ending));
}

/// Removes triangles with a vertex that is not finite; in a point cloud, such points.
void drop_not_finite(TriangleSoup& soup, Scan& scan) {
  const auto bad = std::count_if(soup.corners.begin(), soup.corners.end(),
                                 [](const auto& corner) { return !is_finite(corner); });
  scan.not_finite = static_cast<std::size_t>(bad);
  if (bad == 0) return;
  if (soup.triangles.empty()) {
    std::erase_if(soup.corners, [](const auto& corner) { return !is_finite(corner); });
  }
  std::erase_if(soup.triangles, [&](const auto& triangle) {
    return std::any_of(triangle.begin(), triangle.end(),
                       [&](std::uint32_t corner) { return !is_finite(soup.corners[corner]); });
  });
}

}  // namespace

bool has_scan_ending(const std::filesystem::path& file) {
  return std::find(kScanEndings.begin(), kScanEndings.end(), lower_ending(file)) !=
         kScanEndings.end();
}

Scan read_scan(const std::filesystem::path& file) {
  const std::string bytes = base::read_whole_file(file);
  if (bytes.empty()) base::refuse(file, "is empty", "save the scan again.");
  try {
    Scan scan;
    TriangleSoup soup = parsed(bytes, lower_ending(file));
    if (soup.corners.size() > kMaxPoints) {
      wrong(fmt::format("it holds {} points, more than 40 million", soup.corners.size()));
    }
    scan.is_surface = !soup.triangles.empty();
    drop_not_finite(soup, scan);
    scan.points = scan.is_surface ? spread_over(soup) : std::move(soup.corners);
    if (is_glb(bytes)) scan.unit_mm = kGlbUnit_mm;
    if (scan.points.empty()) wrong("it holds no points");
    return scan;
  } catch (const base::InputError& error) {
    base::refuse(file, fmt::format("cannot be read as a scan ({})", error.what()),
                 "save the scan again, as PLY, OBJ, STL or binary glTF (.glb), uncompressed; or "
                 "open it in MeshLab or CloudCompare and export it as PLY.");
  }
}

}  // namespace repose::vision
