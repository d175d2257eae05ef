// Only surfaces that may let a ray through are asked about their alpha.
#include "scene/coverage.h"

#include <gtest/gtest.h>

#include "support/pictures.h"

namespace lavalight::test {
namespace {

bool isTransparent(AlphaMode mode, float alpha, float vertexAlpha, uint32_t texelAlpha) {
    Scene scene;
    scene.pictures = {pictureOf(2, 1, {{255, 255, 255, 255}, {255, 255, 255, texelAlpha}})};
    Material& material = scene.materials.emplace_back();
    material.alphaMode = mode;
    material.alpha = alpha;
    material.textures[static_cast<size_t>(TextureSlot::baseColor)] = textureOf(0);
    Mesh mesh{"mesh", 0, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {{0, 1, 2}}};
    mesh.colors.assign(3, {0.0f, 0.0f, 0.0f, vertexAlpha});
    scene.meshes = {mesh};
    return transparentMeshes(scene).front();
}

TEST(Coverage, OpaqueSurfacesHaveNoAlpha) {
    EXPECT_FALSE(isTransparent(AlphaMode::opaque, 0.0f, 0.0f, 0));
}

TEST(Coverage, BlendedSurfacesAreTransparentIfAnythingIsBelowOne) {
    EXPECT_FALSE(isTransparent(AlphaMode::blend, 1.0f, 1.0f, 255));
    EXPECT_TRUE(isTransparent(AlphaMode::blend, 0.9f, 1.0f, 255));
    EXPECT_TRUE(isTransparent(AlphaMode::blend, 1.0f, 0.9f, 255));
    EXPECT_TRUE(isTransparent(AlphaMode::blend, 1.0f, 1.0f, 254));
}

TEST(Coverage, MasksAreTransparentIfTheProductFallsBelowTheCutoff) {
    EXPECT_FALSE(isTransparent(AlphaMode::mask, 0.9f, 1.0f, 150));
    EXPECT_TRUE(isTransparent(AlphaMode::mask, 0.9f, 0.9f, 150));
    EXPECT_TRUE(isTransparent(AlphaMode::mask, 1.0f, 1.0f, 100));
    EXPECT_TRUE(isTransparent(AlphaMode::mask, 0.4f, 1.0f, 255));
}

} // namespace
} // namespace lavalight::test
