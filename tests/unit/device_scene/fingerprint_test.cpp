// Scenes are told apart by what is in them, and not by the tree that was built
// over it.
#include "device_scene/fingerprint.h"

#include <gtest/gtest.h>

#include "session/builtin.h"
#include "support/other_trees.h"

namespace lavalight::test {
namespace {

TEST(Fingerprint, IsTheSameForEveryTree) {
    const Scene scene = loadScene("cornell-box");
    SceneData data = packScene(scene);
    const Fingerprints before = fingerprintsOf(data);
    const Bvh median = medianBvh(sceneTriangles(scene));
    ASSERT_NE(median.leafTriangles, data.accelerator.bvh.leafTriangles);
    data.accelerator.bvh = median;
    EXPECT_EQ(fingerprintsOf(data), before);
}

TEST(Fingerprint, NamesTheAccelerator) {
    const Fingerprints parts = fingerprintsOf(packScene(loadScene("cornell-box")));
    EXPECT_EQ(parts.back(), (std::pair<std::string, std::string>("accelerator", "bvh8")));
}

TEST(Fingerprint, IsAnotherWhereACornerHasMoved) {
    Scene scene = loadScene("cornell-box");
    const Fingerprints before = fingerprintsOf(packScene(scene));
    scene.meshes.back().positions.back().x += 1e-4f;
    EXPECT_NE(fingerprintsOf(packScene(scene)).front(), before.front());
}

} // namespace
} // namespace lavalight::test
