// A scene whose BVH would not fit into memory is refused before it is built.
#include <gtest/gtest.h>

#include "base/error.h"
#include "device_scene/scene_data.h"
#include "session/builtin.h"
#include "support/memory_limit.h"

namespace lavalight::test {
namespace {

TEST(SceneMemory, TrianglesWhoseBvhDoesNotFitAreRefusedByTheirNumber) {
    if (!MemoryLimit::isPossible())
        GTEST_SKIP() << "memory cannot be limited here";
    const Scene scene = loadScene("dense-300000");
    const Lights lights = collectLights(scene, scene.environment, LightSelection::power);
    const MemoryLimit limit(uint64_t{96} << 20);
    try {
        (void)packScene(scene, lights);
        FAIL();
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with("cannot prepare dense-300000: its ")) << message;
        EXPECT_NE(message.find("take 14"), std::string::npos) << message; // 147 MiB
    }
}

} // namespace
} // namespace lavalight::test
