#include "dem/shape/scan/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "dem/shape/scan/ply_file.h"

namespace repose::dem {

namespace {

/// Takes the next word from a line; empty at its end.
std::string_view take_word(std::string_view& line) {
  constexpr std::string_view kBlanks = " \t\r\v\f";
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

/// All of a word as a number.
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
    throw base::InputError({.where = fmt::format("line {}", line), .value = what});
  }

  std::string_view take_physical_line() {
    ++line_;
    const std::size_t length = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, length);
    rest_.remove_prefix(std::min(length + 1, rest_.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  /// A backslash at its end continues a line on the next one.
  std::string_view take_line() {
    std::string_view line = take_physical_line();
    if (!line.ends_with('\\')) return line;
    for (; line.ends_with('\\'); line = take_physical_line()) {
      joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
    }
    joined_.append(line);
    return joined_;
  }

  /// What may follow, a weight or colours, says nothing of the place.
  void read_corner(std::string_view line) {
    std::array<float, 3>& corner = surface_.corners.emplace_back();
    for (float& coordinate : corner) {
      const std::string_view word = take_word(line);
      double number = 0;
      if (!read(word, number)) wrong(line_, "a corner must have three coordinates, all numbers");
      coordinate = static_cast<float>(number);
    }
  }

  /// "7", "7/2" or "7//4": only the first number is of a corner; below 0 it counts back from here.
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

  /// A face may stand before its corners.
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

namespace {

constexpr std::size_t kMaxTriangles = 5'000'000;
/// Corners of one face. Cutting a polygon into triangles takes time with the cube of its corners.
constexpr std::size_t kMaxCorners = 256;
constexpr double kLargestCoordinate =
    1e9;  // in any unit; beyond, single precision has no shape left

[[noreturn]] void refuse_unreadable(const std::filesystem::path& file, const std::string& reason) {
  base::refuse(file, fmt::format("cannot be read as a surface ({})", reason),
               "save the scan again; or open it in MeshLab and export it as binary STL.");
}

void check_corners(const std::filesystem::path& file, std::size_t corners) {
  if (corners <= kMaxCorners) return;
  throw base::InputError(
      {.where = file.string(),
       .value = fmt::format("holds a face with {} corners", corners),
       .rule = fmt::format("at most {}", kMaxCorners),
       .fix = "export the scan as triangles (Blender: Triangulate Faces when exporting)."});
}

std::string lower_case_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

std::string content_of(const std::filesystem::path& file, const std::string& ending) {
  constexpr std::array<std::string_view, 3> kEndings = {".stl", ".obj", ".ply"};
  std::error_code ignored;
  if (!std::filesystem::is_directory(file, ignored) && std::filesystem::exists(file, ignored) &&
      std::find(kEndings.begin(), kEndings.end(), ending) == kEndings.end()) {
    base::refuse(file, "is not named as an STL, OBJ or PLY file", "save the scan as one of these.");
  }
  std::string content = base::read_whole_file(file);
  if (content.empty()) base::refuse(file, "is empty", "save the scan again.");
  return content;
}

Vector vector_of(const aiVector3D& from) {
  return {static_cast<double>(from.x), static_cast<double>(from.y), static_cast<double>(from.z)};
}

void append_part(const aiMesh& part, Mesh& mesh) {
  const auto first = static_cast<int>(mesh.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    mesh.vertices.push_back(vector_of(part.mVertices[i]));
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // a lone point or line
    mesh.triangles.push_back({first + static_cast<int>(face.mIndices[0]),
                              first + static_cast<int>(face.mIndices[1]),
                              first + static_cast<int>(face.mIndices[2])});
  }
}

void check_coordinates(const std::filesystem::path& file, const Mesh& mesh) {
  const auto is_bad = [](const Vector& vertex) {
    return !vertex.allFinite() || vertex.cwiseAbs().maxCoeff() > kLargestCoordinate;
  };
  const auto bad = std::count_if(mesh.vertices.begin(), mesh.vertices.end(), is_bad);
  if (bad > 0) {
    base::refuse(file,
                 fmt::format("{} of {} corners are not at finite coordinates below 1e9", bad,
                             mesh.vertices.size()),
                 "export the scan again; in MeshLab, Filters > Cleaning and Repairing > Remove "
                 "Vertices wrt Quality "
                 "or delete them by hand.");
  }
}

/// Through assimp, which sees these bytes and no file.
Mesh read_by_assimp(const std::filesystem::path& file, std::string_view bytes,
                    const std::string& ending) {
  Assimp::Importer importer;
  importer.SetIOHandler(new Assimp::MemoryIOSystem(
      reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), nullptr));
  const aiScene* scene = importer.ReadFile(AI_MEMORYIO_MAGIC_FILENAME + ending, 0);
  if (scene == nullptr) refuse_unreadable(file, importer.GetErrorString());
  for (const aiMesh* part : std::span(scene->mMeshes, scene->mNumMeshes)) {
    for (const aiFace& face : std::span(part->mFaces, part->mNumFaces)) {
      check_corners(file, face.mNumIndices);
      for (const unsigned corner : std::span(face.mIndices, face.mNumIndices)) {
        if (corner >= part->mNumVertices) refuse_unreadable(file, "a face names no corner");
      }
    }
  }
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr) refuse_unreadable(file, importer.GetErrorString());
  Mesh mesh;
  for (const aiMesh* part : std::span(scene->mMeshes, scene->mNumMeshes)) append_part(*part, mesh);
  return mesh;
}

/// For assimp to cut faces of more than three corners.
std::string obj_of(const PolygonSurface& surface) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const auto& [x, y, z] : surface.corners) fmt::format_to(out, "v {} {} {}\n", x, y, z);
  for (const std::vector<int>& face : surface.faces) {
    text += 'f';
    for (const int corner : face) fmt::format_to(out, " {}", corner + 1);
    text += '\n';
  }
  return text;
}

/// Files of polygons are read here: assimp does not survive all that a damaged one may hold.
PolygonSurface polygons_in(const std::filesystem::path& file, std::string_view bytes,
                           const std::string& ending) {
  try {
    return ending == ".ply" ? parse_ply(bytes) : parse_obj(bytes);
  } catch (const base::InputError& error) {
    refuse_unreadable(file, error.what());
  }
}

Mesh mesh_of(const std::filesystem::path& file, const PolygonSurface& surface) {
  std::size_t most = 0;
  for (const std::vector<int>& face : surface.faces) most = std::max(most, face.size());
  check_corners(file, most);
  if (most > 3) return read_by_assimp(file, obj_of(surface), ".obj");
  Mesh mesh;
  for (const auto& [x, y, z] : surface.corners) {
    mesh.vertices.emplace_back(static_cast<double>(x), static_cast<double>(y),
                               static_cast<double>(z));
  }
  for (const std::vector<int>& face : surface.faces) {
    mesh.triangles.push_back({face[0], face[1], face[2]});
  }
  return mesh;
}

}  // namespace

Mesh read_mesh_file(const std::filesystem::path& file) {
  const std::string ending = lower_case_ending(file);
  const std::string bytes = content_of(file, ending);
  const Mesh mesh = ending == ".stl" ? read_by_assimp(file, bytes, ending)
                                     : mesh_of(file, polygons_in(file, bytes, ending));
  if (mesh.triangles.empty()) {
    base::refuse(file, "holds no triangles",
                 "if it is a cloud of points, make a surface of it (MeshLab: "
                 "Filters > Remeshing, Simplification and Reconstruction > Screened Poisson).");
  }
  if (mesh.triangles.size() > kMaxTriangles) {
    base::refuse(file,
                 fmt::format("holds {} triangles, more than 5 million", mesh.triangles.size()),
                 "thin it out (MeshLab: Filters > "
                 "Remeshing, Simplification and Reconstruction > Quadric Edge Collapse).");
  }
  check_coordinates(file, mesh);
  return mesh;
}

}  // namespace repose::dem
