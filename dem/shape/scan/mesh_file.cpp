#include "dem/shape/scan/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

namespace repose::dem {
namespace {

constexpr std::size_t kMaxTriangles = 5'000'000;
constexpr double kLargestCoordinate =
    1e9;  // in any unit; beyond, single precision has no shape left

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& error) {
  throw std::invalid_argument(file.string() + ": " + error);
}

void check_is_readable(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (!std::filesystem::exists(file)) refuse(file, "there is no such file. Fix: check the name.");
  if (std::filesystem::is_directory(file)) refuse(file, "is a folder. Fix: name one scan.");
  constexpr std::array<const char*, 3> kEndings = {".stl", ".obj", ".ply"};
  if (std::find(kEndings.begin(), kEndings.end(), ending) == kEndings.end()) {
    refuse(file, "is no STL, OBJ or PLY by its name. Fix: save the scan as one of these.");
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(file, "cannot be read. Fix: check who may read it.");
  if (stream.peek() == std::ifstream::traits_type::eof()) {
    refuse(file, "is empty. Fix: save the scan again.");
  }
}

Vector vector_of(const aiVector3D& from) {
  return {static_cast<double>(from.x), static_cast<double>(from.y), static_cast<double>(from.z)};
}

void append(const aiMesh& part, Mesh& mesh) {
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
    refuse(file,
           std::to_string(bad) + " of " + std::to_string(mesh.vertices.size()) +
               " corners are not at finite coordinates below 1e9. Fix: export the scan again; "
               "in MeshLab, Filters > Cleaning and Repairing > Remove Vertices wrt Quality "
               "or delete them by hand.");
  }
}

}  // namespace

Mesh read_mesh_file(const std::filesystem::path& file) {
  check_is_readable(file);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
  if (scene == nullptr) {
    refuse(file, std::string("cannot be read as a surface (") + importer.GetErrorString() +
                     "). Fix: open it in MeshLab and export it as binary STL.");
  }
  Mesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(*scene->mMeshes[i], mesh);
  if (mesh.triangles.empty()) {
    refuse(file,
           "holds no triangles. Fix: if it is a cloud of points, make a surface of it (MeshLab: "
           "Filters > Remeshing, Simplification and Reconstruction > Screened Poisson).");
  }
  if (mesh.triangles.size() > kMaxTriangles) {
    refuse(file, "holds " + std::to_string(mesh.triangles.size()) +
                     " triangles, more than 5 million. Fix: thin it out (MeshLab: Filters > "
                     "Remeshing, Simplification and Reconstruction > Quadric Edge Collapse).");
  }
  check_coordinates(file, mesh);
  return mesh;
}

}  // namespace repose::dem
