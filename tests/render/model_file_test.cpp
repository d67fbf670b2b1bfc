#include "render/model_file.h"

#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gmock/gmock.h>

#include "tests/render/drawn.h"
#include "tests/support/nut_heap.h"

namespace repose::render {
namespace {

using repose::testing::nut_heap;

const aiScene* imported(Assimp::Importer& importer, const std::vector<std::byte>& glb) {
  return importer.ReadFileFromMemory(glb.data(), glb.size(), 0, "glb");
}

TEST(ModelFile, EveryGrainIsANodeThatSharesOneMesh) {
  const Scene heap = nut_heap(6, .5, 1);
  const auto glb = glb_of(heap, Shown::mesh);
  Assimp::Importer importer;
  const aiScene* scene = imported(importer, glb);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  EXPECT_EQ(scene->mNumMeshes, 2U);  // nut, plate
  const aiNode* root = scene->mRootNode;
  ASSERT_EQ(root->mNumChildren, heap.grains.size() + heap.walls.size());
  for (std::size_t k = 0; k < heap.grains.size(); ++k) {
    const aiNode* node = root->FindNode(("grain " + std::to_string(k)).c_str());
    ASSERT_NE(node, nullptr);
    ASSERT_EQ(node->mNumMeshes, 1U);
    EXPECT_EQ(node->mMeshes[0], root->mChildren[0]->mMeshes[0]);
  }
}

TEST(ModelFile, IsInMetresWithYUpwards) {
  const dem::Vector place(.1, .2, .3);
  const Scene scene = repose::testing::sphere_scene(.01, {place});
  const auto glb = glb_of(scene, Shown::mesh);
  Assimp::Importer importer;
  const aiScene* read = imported(importer, glb);
  ASSERT_NE(read, nullptr) << importer.GetErrorString();
  const aiNode* node = read->mRootNode->FindNode("spheres 0");
  ASSERT_NE(node, nullptr);
  aiMatrix4x4 whole = node->mTransformation;
  for (const aiNode* at = node->mParent; at != nullptr; at = at->mParent) {
    whole = at->mTransformation * whole;
  }
  EXPECT_NEAR(whole.a4, place.x(), 1e-6);
  EXPECT_NEAR(whole.b4, place.z(), 1e-6);
  EXPECT_NEAR(whole.c4, -place.y(), 1e-6);
  float reach = 0;
  const aiMesh& mesh = *read->mMeshes[node->mMeshes[0]];
  for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
    reach = std::max(reach, mesh.mVertices[k].Length());
  }
  EXPECT_NEAR(reach, .01, 1e-4);
  EXPECT_TRUE(mesh.HasNormals());
}

TEST(ModelFile, AnEmptySceneIsRefused) {
  EXPECT_NE(error_of([] { glb_of(Scene{}, Shown::mesh); }), "");
}

}  // namespace
}  // namespace repose::render
