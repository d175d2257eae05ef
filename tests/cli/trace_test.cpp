// `lavalight trace` tells of the path that a render takes, and of no other.
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "image/exr.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

using nlohmann::json;

class Trace : public testing::Test {
  protected:
    [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments) const {
        return runLavalight(arguments, folder_.path());
    }
    [[nodiscard]] json trace(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"trace", "--validate"});
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return json::parse(result.out);
    }

    const TemporaryFolder folder_;
};

glm::vec3 vectorOf(const json& list) {
    return {list.at(0), list.at(1), list.at(2)};
}

// What the vertices add up to.
glm::vec3 sumOf(const json& path) {
    glm::vec3 sum(0.0f);
    for (const json& vertex : path.at("vertices")) {
        sum += vectorOf(vertex.at("emitted"));
        if (vertex.contains("light") && vertex.at("light").at("arrives").get<bool>())
            sum += vectorOf(vertex.at("light").at("contribution"));
    }
    return sum;
}

void expectNear(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_LE(glm::length(a - b), 1e-5f * (1.0f + glm::length(b)));
}

TEST_F(Trace, PathsAreThoseOfTheRender) {
    const std::vector<std::string> settings{"cornell-glass", "--size", "8x8", "--seed", "5"};
    std::vector<std::string> words{"render", "--spp", "1", "-o", "a.exr"};
    words.insert(words.end(), settings.begin(), settings.end());
    ASSERT_EQ(run(words).exitCode, 0);
    const ExrFile image = readExr(folder_ / "a.exr");
    for (const glm::uvec2& pixel : {glm::uvec2(1, 2), glm::uvec2(5, 5), glm::uvec2(3, 6), glm::uvec2(4, 0)}) {
        words = settings;
        words.insert(words.end(), {"--pixel", std::to_string(pixel.x) + "," + std::to_string(pixel.y)});
        const json path = trace(words);
        expectNear(vectorOf(path.at("radiance")), image.radiance().at(pixel.x, pixel.y));
        expectNear(sumOf(path), vectorOf(path.at("radiance")));
    }
}

TEST_F(Trace, EveryVertexSaysHowThePathWentOn) {
    const json path = trace({"furnace", "--pixel", "8,6", "--size", "16x12", "--roulette", "off", "--sample",
                             "3", "--max-bounces", "2"});
    const json& vertices = path.at("vertices");
    const json& first = vertices.at(0);
    EXPECT_EQ(first.at("vertex"), 1);
    EXPECT_EQ(first.at("side"), "front");
    EXPECT_EQ(vectorOf(first.at("throughput")), glm::vec3(1.0f));
    EXPECT_GT(first.at("next").at("pdf"), 0.0);
    EXPECT_NEAR(glm::length(vectorOf(first.at("next").at("direction"))), 1.0f, 1e-5f);
    EXPECT_EQ(first.at("survival"), 1.0);
    EXPECT_EQ(vertices.back().at("fate"), "left the scene");
    EXPECT_FALSE(vertices.back().contains("position"));
    EXPECT_EQ(trace({"cornell-box", "--pixel", "8,8", "--size", "16x16", "--max-bounces", "0"})
                  .at("vertices")
                  .at(0)
                  .at("fate"),
              "cut by --max-bounces");
}

TEST_F(Trace, PathsMeetTheGroundThatRenderLays) {
    const std::vector<std::string> settings{"furnace", "--size",    "8x8",  "--look-from",
                                            "0,4,8",   "--look-at", "0,0,0"};
    const auto below = [&](const std::string& ground) { // the lowest pixel, which looks down
        std::vector<std::string> words = settings;
        words.insert(words.end(), {"--ground", ground, "--pixel", "4,7"});
        return trace(words).at("vertices").at(0);
    };
    EXPECT_EQ(below("none").at("fate"), "left the scene");
    const json caught = below("shadow");
    EXPECT_EQ(caught.at("fate"), "caught by the ground");
    EXPECT_TRUE(caught.contains("light"));
    const json lambert = below("#808080");
    EXPECT_EQ(lambert.at("fate"), "goes on");
    EXPECT_LT(lambert.at("position").at(1), -0.99);
}

TEST_F(Trace, RouletteIsToldWithItsProbability) {
    uint32_t killed = 0;
    uint32_t survived = 0;
    for (uint32_t sample = 0; sample < 4; ++sample) {
        const json path = trace({"cornell-box", "--pixel", "8,8", "--size", "16x16", "--roulette", "constant",
                                 "--roulette-start", "1", "--sample", std::to_string(sample)});
        for (const json& vertex : path.at("vertices")) {
            const std::string fate = vertex.at("fate");
            killed += fate == "killed by roulette" ? 1 : 0;
            survived += fate == "goes on" ? 1 : 0;
            const bool wasAsked = fate == "killed by roulette" || fate == "goes on";
            EXPECT_EQ(vertex.at("survival"), wasAsked ? 0.5 : 1.0) << fate;
        }
    }
    EXPECT_GT(killed, 0u);
    EXPECT_GT(survived, 0u);
}

TEST_F(Trace, PixelsOutsideTheImageAreRefused) {
    for (const char* pixel : {"16,0", "0,16", "-1,0", "1", "1,2,3", "1.5,2", "x,y"}) {
        const ProgramResult result =
            run({"trace", "cornell-box", "--size", "16x16", std::string("--pixel=") + pixel});
        EXPECT_EQ(result.exitCode, 2) << pixel;
        EXPECT_NE(result.err.find("--pixel"), std::string::npos) << result.err;
    }
    EXPECT_EQ(run({"trace", "cornell-box"}).exitCode, 2);
}

} // namespace
} // namespace lavalight::test
