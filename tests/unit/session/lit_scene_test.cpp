// Which light a scene is given.
#include "session/lit_scene.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "session/ledger.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using test::TemporaryFolder;

class LitScene : public testing::Test {
  protected:
    // A triangle whose material emits so much.
    [[nodiscard]] std::string file(const std::string& emission) const {
        const std::string path = (folder_ / "triangle.gltf").string();
        writeFileAtomically(
            path, R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
                  R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],)"
                  R"("materials":[{"emissiveFactor":)" +
                      emission +
                      R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
                      R"("min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
                      R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
                      R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
        return path;
    }
    [[nodiscard]] static size_t warnings(const Scene& scene) {
        return std::ranges::count_if(
            scene.warnings, [](const std::string& w) { return w.find("no light") != std::string::npos; });
    }
    [[nodiscard]] static bool ledgerHas(const Scene& scene, const std::string& cause) {
        const std::vector<LedgerEntry> ledger = makeLedger(scene, {}, {}, StopReason::samples);
        return std::ranges::any_of(ledger, [&](const LedgerEntry& entry) { return entry.cause == cause; });
    }

  private:
    TemporaryFolder folder_;
};

TEST_F(LitScene, AStudioLightsAFileWithoutLightAndAMessageAndTheLedgerSaySo) {
    const Scene scene = loadLitScene(file("[0,0,0]"), {}, {});
    ASSERT_TRUE(scene.environmentMap);
    EXPECT_EQ(scene.environmentMap->source, "studio");
    EXPECT_EQ(warnings(scene), 1u);
    EXPECT_TRUE(ledgerHas(scene, "stand-in-light"));
}

TEST_F(LitScene, LightOfItsOwnIsTheOnlyOne) {
    const Scene scene = loadLitScene(file("[1,0,0]"), {}, {});
    EXPECT_FALSE(scene.environmentMap);
    EXPECT_EQ(scene.environment, glm::vec3(0.0f));
    EXPECT_EQ(warnings(scene), 0u);
    EXPECT_FALSE(ledgerHas(scene, "stand-in-light"));
}

TEST_F(LitScene, LightThatIsAskedForStandsInForNothing) {
    LightingSettings constant;
    constant.constant = glm::vec3(0.5f);
    LightingSettings studio;
    studio.procedural = ProceduralEnvironment::studio;
    for (const LightingSettings& lighting : {constant, studio}) {
        const Scene scene = loadLitScene(file("[0,0,0]"), {}, lighting);
        EXPECT_EQ(scene.environmentMap.has_value(), !lighting.constant.has_value());
        EXPECT_EQ(warnings(scene), 0u);
        EXPECT_FALSE(ledgerHas(scene, "stand-in-light"));
    }
    EXPECT_TRUE(loadLitScene(file("[1,0,0]"), {}, studio).environmentMap); // beside the light of its own
}

TEST_F(LitScene, SurroundingsOfABuiltInSceneAreItsOwn) {
    const Scene furnace = loadLitScene("furnace", {}, {});
    EXPECT_FALSE(furnace.environmentMap);
    EXPECT_EQ(furnace.environment, glm::vec3(1.0f));
    EXPECT_EQ(warnings(furnace), 0u);
}

TEST_F(LitScene, ARotationWithoutAMapIsRefused) {
    LightingSettings turned;
    turned.rotation = 10.0f;
    EXPECT_NO_THROW(static_cast<void>(loadLitScene(file("[0,0,0]"), {}, turned))); // the studio turns
    EXPECT_THROW(static_cast<void>(loadLitScene(file("[1,0,0]"), {}, turned)), UsageError);
}

} // namespace
} // namespace lavalight
