#include "dem/shape/scan/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/polygon_file.h"

namespace repose::dem {

namespace {

constexpr std::size_t kMaxTriangles = 5'000'000;
/// Maximum corners per face. The time to triangulate a polygon grows with the cube of its corners.
constexpr std::size_t kMaxCorners = 256;
constexpr double kLargestCoordinate = 1e9;  // in any unit; single precision loses the shape beyond

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

/// Reads with assimp, which gets only these bytes, no file.
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

/// In single precision as in STL files, so that a surface is the same from either format.
std::array<float, 3> in_single_precision(const base::Corner& corner) {
  return {static_cast<float>(corner[0]), static_cast<float>(corner[1]),
          static_cast<float>(corner[2])};
}

/// As OBJ text, for assimp to triangulate faces of more than three corners.
std::string obj_of(const base::PolygonSurface& surface) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const base::Corner& corner : surface.corners) {
    const auto [x, y, z] = in_single_precision(corner);
    fmt::format_to(out, "v {} {} {}\n", x, y, z);
  }
  for (const std::vector<int>& face : surface.faces) {
    text += 'f';
    for (const int corner : face) fmt::format_to(out, " {}", corner + 1);
    text += '\n';
  }
  return text;
}

/// PLY and OBJ files are parsed here: damaged ones can crash assimp.
base::PolygonSurface polygons_in(const std::filesystem::path& file, std::string_view bytes,
                                 const std::string& ending) {
  try {
    return ending == ".ply" ? base::parse_ply(bytes) : base::parse_obj(bytes);
  } catch (const base::InputError& error) {
    refuse_unreadable(file, error.what());
  }
}

Mesh mesh_of(const std::filesystem::path& file, const base::PolygonSurface& surface) {
  std::size_t most = 0;
  for (const std::vector<int>& face : surface.faces) most = std::max(most, face.size());
  check_corners(file, most);
  if (most > 3) return read_by_assimp(file, obj_of(surface), ".obj");
  Mesh mesh;
  for (const base::Corner& corner : surface.corners) {
    const auto [x, y, z] = in_single_precision(corner);
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
