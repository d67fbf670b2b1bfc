#include "dem/shape/clump/shape_export.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include <assimp/Exporter.hpp>
#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include "base/input_error.h"

namespace repose::dem {
namespace {

constexpr int kBallRings = 16;
constexpr int kAroundBallRing = 32;

void append_sphere(const ClumpSphere& sphere, Mesh& mesh) {
  const auto first = static_cast<int>(mesh.vertices.size());
  for (int ring = 0; ring <= kBallRings; ++ring) {
    const double tilt = std::numbers::pi * ring / kBallRings;
    for (int k = 0; k < kAroundBallRing; ++k) {
      const double turn = 2 * std::numbers::pi * k / kAroundBallRing;
      const Vector way(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                       std::cos(tilt));
      mesh.vertices.push_back(sphere.centre + sphere.radius * way);
    }
  }
  for (int ring = 0; ring < kBallRings; ++ring) {
    for (int k = 0; k < kAroundBallRing; ++k) {
      const int next = (k + 1) % kAroundBallRing;
      const int a = first + ring * kAroundBallRing + k, b = first + ring * kAroundBallRing + next;
      const int c = a + kAroundBallRing, d = b + kAroundBallRing;
      if (ring > 0) mesh.triangles.push_back({a, c, b});
      if (ring + 1 < kBallRings) mesh.triangles.push_back({b, c, d});
    }
  }
}

aiVector3D library_vector(const Vector& vector) {
  return {static_cast<ai_real>(vector.x()), static_cast<ai_real>(vector.y()),
          static_cast<ai_real>(vector.z())};
}

/// The library's scene deletes what it owns.
aiMesh* library_mesh(const Mesh& mesh, const char* name, unsigned material, double scale) {
  auto* part = new aiMesh;
  part->mName = aiString(name);
  part->mMaterialIndex = material;
  part->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  part->mNumVertices = static_cast<unsigned>(mesh.vertices.size());
  part->mVertices = new aiVector3D[mesh.vertices.size()];
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    part->mVertices[i] = library_vector(scale * mesh.vertices[i]);
  }
  part->mNumFaces = static_cast<unsigned>(mesh.triangles.size());
  part->mFaces = new aiFace[mesh.triangles.size()];
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    aiFace& face = part->mFaces[t];
    face.mNumIndices = 3;
    face.mIndices = new unsigned[3];
    for (std::size_t i = 0; i < 3; ++i) {
      face.mIndices[i] = static_cast<unsigned>(mesh.triangles[t][i]);
    }
  }
  return part;
}

aiMaterial* library_material(const char* name, const aiColor4D& colour) {
  auto* material = new aiMaterial;
  const aiString text(name);
  material->AddProperty(&text, AI_MATKEY_NAME);
  material->AddProperty(&colour, 1, AI_MATKEY_BASE_COLOR);
  const aiString blending(colour.a < 1 ? "BLEND" : "OPAQUE");
  material->AddProperty(&blending, AI_MATKEY_GLTF_ALPHAMODE);
  return material;
}

std::unique_ptr<aiScene> library_scene(const ClumpShape& shape, double scale) {
  Mesh spheres;
  for (const ClumpSphere& sphere : shape.spheres) append_sphere(sphere, spheres);
  const bool has_surface = !shape.surface.triangles.empty();
  const unsigned parts = has_surface ? 2 : 1;

  auto scene = std::make_unique<aiScene>();
  scene->mNumMeshes = scene->mNumMaterials = parts;
  scene->mMeshes = new aiMesh*[parts];
  scene->mMaterials = new aiMaterial*[parts];
  scene->mMeshes[0] = library_mesh(spheres, "spheres", 0, scale);
  scene->mMaterials[0] = library_material("spheres", {0.25F, 0.45F, 0.75F, 1.0F});
  if (has_surface) {
    scene->mMeshes[1] = library_mesh(shape.surface, "surface", 1, scale);
    scene->mMaterials[1] = library_material("surface", {0.65F, 0.40F, 0.20F, 0.45F});
  }
  scene->mRootNode = new aiNode("clump");
  scene->mRootNode->mNumMeshes = parts;
  scene->mRootNode->mMeshes = new unsigned[parts];
  for (unsigned i = 0; i < parts; ++i) scene->mRootNode->mMeshes[i] = i;
  return scene;
}

}  // namespace

std::vector<std::byte> export_shape(const ClumpShape& shape, ShapeFormat format) {
  if (shape.spheres.empty()) {
    throw base::InputError(
        {.where = "clump", .value = "has no spheres to export", .fix = "give at least one."});
  }
  const bool is_stl = format == ShapeFormat::stl;
  const std::unique_ptr<aiScene> scene = library_scene(shape, is_stl ? 1e3 : 1);
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(scene.get(), is_stl ? "stlb" : "glb2");
  if (blob == nullptr) {
    throw std::runtime_error(std::string("clump: cannot be exported: ") +
                             exporter.GetErrorString());
  }
  const auto* first = static_cast<const std::byte*>(blob->data);
  return {first, first + blob->size};
}

}  // namespace repose::dem
