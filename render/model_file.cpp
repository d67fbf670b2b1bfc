#include "render/model_file.h"

#include <memory>
#include <stdexcept>
#include <string>

#include <assimp/Exporter.hpp>
#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include "base/input_error.h"
#include "render/scene/extent.h"
#include "render/scene/surface.h"

namespace repose::render {
namespace {

using dem::Vector;

/// As a fraction of a grain's extent: spheres look round, and files of clumps with many spheres
/// stay small.
constexpr double kSphereTolerance = 0.002;
constexpr double kModelSlab =
    3;  ///< half the side of the slab that stands for a plane / radius of a ball around all grains
constexpr double kWholeSide_m = 1e9;

/// From z up to y up.
const aiMatrix4x4 kTurn(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1);

enum Material : unsigned { surface_material, sphere_material, wall_material, material_count };

/// The library's scene deletes the meshes that it owns.
aiMesh* library_mesh(const Surface& surface, const std::string& name, Material material) {
  constexpr std::size_t kFloats = 6;
  const std::size_t vertices = surface.vertices.size() / kFloats;
  auto* mesh = new aiMesh;
  mesh->mName = aiString(name);
  mesh->mMaterialIndex = material;
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumVertices = static_cast<unsigned>(vertices);
  mesh->mVertices = new aiVector3D[vertices];
  mesh->mNormals = new aiVector3D[vertices];
  for (std::size_t k = 0; k < vertices; ++k) {
    const float* first = &surface.vertices[k * kFloats];
    mesh->mVertices[k] = {first[0], first[1], first[2]};
    mesh->mNormals[k] = {first[3], first[4], first[5]};
  }
  mesh->mNumFaces = static_cast<unsigned>(surface.triangles());
  mesh->mFaces = new aiFace[surface.triangles()];
  for (std::size_t t = 0; t < surface.triangles(); ++t) {
    aiFace& face = mesh->mFaces[t];
    face.mNumIndices = 3;
    face.mIndices = new unsigned[3];
    for (std::size_t i = 0; i < 3; ++i) face.mIndices[i] = surface.corners[3 * t + i];
  }
  return mesh;
}

aiMaterial* library_material(const char* name, const aiColor4D& colour, float metal, float rough) {
  auto* material = new aiMaterial;
  const aiString text(name);
  material->AddProperty(&text, AI_MATKEY_NAME);
  material->AddProperty(&colour, 1, AI_MATKEY_BASE_COLOR);
  material->AddProperty(&metal, 1, AI_MATKEY_METALLIC_FACTOR);
  material->AddProperty(&rough, 1, AI_MATKEY_ROUGHNESS_FACTOR);
  const bool is_two_sided = true;
  material->AddProperty(&is_two_sided, 1, AI_MATKEY_TWOSIDED);
  return material;
}

/// Meshes and the nodes that place them, until the library's scene takes ownership.
class Assembly {
 public:
  unsigned add_mesh(const Surface& surface, const std::string& name, Material material) {
    meshes_.push_back(library_mesh(surface, name, material));
    return static_cast<unsigned>(meshes_.size() - 1);
  }

  void place(unsigned mesh, const std::string& name, const dem::Pose& pose) {
    auto* node = new aiNode(name);
    const Eigen::Matrix3d turn = pose.orientation.toRotationMatrix();
    for (int row = 0; row < 3; ++row) {
      const auto at = static_cast<unsigned>(row);
      for (int column = 0; column < 3; ++column) {
        node->mTransformation[at][column] = static_cast<ai_real>(turn(row, column));
      }
      node->mTransformation[at][3] = static_cast<ai_real>(pose.position[row]);
    }
    node->mNumMeshes = 1;
    node->mMeshes = new unsigned[1]{mesh};
    nodes_.push_back(node);
  }

  std::unique_ptr<aiScene> take() {
    auto scene = std::make_unique<aiScene>();
    scene->mNumMaterials = material_count;
    scene->mMaterials = new aiMaterial* [material_count] {
      library_material("grain", {0.32F, 0.13F, 0.04F, 1.0F}, 0, 0.55F),
          library_material("spheres", {0.05F, 0.17F, 0.52F, 1.0F}, 0, 0.6F),
          library_material("wall", {0.55F, 0.56F, 0.58F, 1.0F}, 0.6F, 0.5F)
    };
    scene->mNumMeshes = static_cast<unsigned>(meshes_.size());
    scene->mMeshes = new aiMesh*[meshes_.size()];
    std::copy(meshes_.begin(), meshes_.end(), scene->mMeshes);
    scene->mRootNode = new aiNode("scene");
    scene->mRootNode->mTransformation = kTurn;
    scene->mRootNode->addChildren(static_cast<unsigned>(nodes_.size()), nodes_.data());
    return scene;
  }

 private:
  std::vector<aiMesh*> meshes_;
  std::vector<aiNode*> nodes_;
};

void add_grains(Assembly& assembly, const Scene& scene, int shape_number, bool as_spheres) {
  const dem::ClumpShape& shape = scene.shapes[static_cast<std::size_t>(shape_number)];
  const double tolerance_m = kSphereTolerance * reach_m(shape);
  const Surface surface =
      as_spheres ? sphere_surface(shape.spheres, tolerance_m) : grain_surface(shape.surface, 0);
  const char* word = as_spheres ? "spheres" : "grain";
  const unsigned mesh = assembly.add_mesh(surface, word + std::to_string(shape_number),
                                          as_spheres ? sphere_material : surface_material);
  for (const PlacedGrain& grain : scene.grains) {
    if (grain.shape != shape_number) continue;
    assembly.place(mesh, word + (' ' + std::to_string(grain.number)), grain.pose);
  }
}

void add_walls(Assembly& assembly, const Scene& scene) {
  const Eigen::AlignedBox3d bounds = grain_bounds(scene, Eigen::Matrix3d::Identity());
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const PlacedWall& wall = scene.walls[k];
    const Vector middle =
        wall.pose.orientation.conjugate() * (bounds.center() - wall.pose.position);
    const Surface surface =
        wall_surface(wall.shape, middle, .5 * kModelSlab * bounds.diagonal().norm(), kWholeSide_m);
    const std::string name = "wall " + std::to_string(k);
    assembly.place(assembly.add_mesh(surface, name, wall_material), name, wall.pose);
  }
}

}  // namespace

std::vector<std::byte> glb_of(const Scene& scene, Shown shown) {
  if (scene.grains.empty()) {
    throw base::InputError({.where = "scene",
                            .value = "it has no grains to be seen",
                            .fix = "a state in which some are left."});
  }
  Assembly assembly;
  for (std::size_t k = 0; k < scene.shapes.size(); ++k) {
    const bool has_mesh = !scene.shapes[k].surface.triangles.empty();
    if (has_mesh && shown != Shown::spheres) {
      add_grains(assembly, scene, static_cast<int>(k), false);
    }
    if (!has_mesh || shown != Shown::mesh) add_grains(assembly, scene, static_cast<int>(k), true);
  }
  add_walls(assembly, scene);
  const std::unique_ptr<aiScene> library = assembly.take();
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(library.get(), "glb2");
  if (blob == nullptr) {
    throw std::runtime_error(std::string("scene: cannot be exported: ") +
                             exporter.GetErrorString());
  }
  const auto* first = static_cast<const std::byte*>(blob->data);
  return {first, first + blob->size};
}

}  // namespace repose::render
