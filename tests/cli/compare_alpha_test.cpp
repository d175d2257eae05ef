// `lavalight compare` where files have an alpha channel: it counts where either file has it.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "image/exr.h"
#include "image/png.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;

constexpr uint32_t kSide = 16;

class CompareAlpha : public testing::Test {
  protected:
    // An EXR file of grey 0.5 without variances, with an alpha channel if one is given.
    void writeGrey(const std::string& name, const std::vector<float>& alpha) const {
        Image grey(kSide, kSide);
        Image opacity(kSide, kSide);
        for (size_t i = 0; i < grey.pixels.size(); ++i) {
            grey.pixels[i] = glm::vec3(0.5f);
            opacity.pixels[i].x = alpha.empty() ? 0.0f : alpha[i];
        }
        Rendering rendering(grey, std::nullopt, std::vector<uint32_t>(grey.pixels.size(), 1));
        if (!alpha.empty())
            rendering.layers.push_back({"A", {"A"}, opacity, std::nullopt});
        writeExr(folder_ / name, rendering, {});
    }

    [[nodiscard]] ProgramResult compare(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "compare");
        return runLavalight(arguments, folder_.path());
    }

    const TemporaryFolder folder_;
};

const std::string kField = std::string(LAVALIGHT_SOURCE_DIR) + "/tests/field/";
const std::vector<float> kOpaque(size_t{kSide} * kSide, 1.0f);
const std::vector<float> kClear(size_t{kSide} * kSide, 0.0f);

TEST_F(CompareAlpha, ObjectThatHasVanishedIsADifferenceByEveryCriterion) {
    const std::string opaque = kField + "opaque.png";
    const std::string clear = kField + "transparent.png";
    for (const std::vector<std::string>& criterion :
         {std::vector<std::string>{}, {"--threshold", "0.01"}, {"--flip-threshold", "0.5"}}) {
        for (const auto& [a, b] : {std::pair(opaque, clear), std::pair(clear, opaque)}) {
            std::vector<std::string> arguments{a, b};
            arguments.insert(arguments.end(), criterion.begin(), criterion.end());
            const ProgramResult result = compare(arguments);
            EXPECT_EQ(result.exitCode, 1) << result.out;
            EXPECT_NE(result.out.find("relMSE of A"), std::string::npos) << result.out;
        }
        std::vector<std::string> arguments{clear, clear};
        arguments.insert(arguments.end(), criterion.begin(), criterion.end());
        EXPECT_EQ(compare(arguments).exitCode, 0);
    }
}

// relMSE of 0 against 1 is 1 / 1.01, and of 1 against 0 is 1 / 0.01.
TEST_F(CompareAlpha, FileWithoutAlphaIsOpaque) {
    writeGrey("plain.exr", {});
    writeGrey("opaque.exr", kOpaque);
    writeGrey("clear.exr", kClear);
    EXPECT_EQ(compare({"plain.exr", "opaque.exr"}).exitCode, 0);
    EXPECT_EQ(compare({"opaque.exr", "plain.exr"}).exitCode, 0);
    for (const char* other : {"plain.exr", "opaque.exr"}) {
        const ProgramResult vanished = compare({"clear.exr", other, "--json"});
        EXPECT_EQ(vanished.exitCode, 1) << vanished.err;
        EXPECT_NEAR(json::parse(vanished.out).at("layers").at("A").at("relMse").get<double>(), 1.0 / 1.01,
                    1e-6);
        const ProgramResult appeared = compare({other, "clear.exr", "--json"});
        EXPECT_EQ(appeared.exitCode, 1) << appeared.err;
        EXPECT_NEAR(json::parse(appeared.out).at("layers").at("A").at("relMse").get<double>(), 100.0, 1e-4);
    }
    EXPECT_FALSE(json::parse(compare({"plain.exr", "plain.exr", "--json"}).out).contains("layers"));
}

TEST_F(CompareAlpha, LayersOfColourHaveOneToo) {
    const auto write = [&](const char* name, bool hasAlpha) {
        Image half(kSide, kSide);
        for (glm::vec3& pixel : half.pixels)
            pixel = glm::vec3(0.5f);
        Rendering rendering(half, std::nullopt, std::vector<uint32_t>(half.pixels.size(), 1));
        rendering.layers.push_back({"glow", {"glow.R", "glow.G", "glow.B"}, half, std::nullopt});
        if (hasAlpha)
            rendering.layers.push_back({"glow.A", {"glow.A"}, half, std::nullopt});
        writeExr(folder_ / name, rendering, {});
    };
    write("with.exr", true);
    write("without.exr", false);
    EXPECT_EQ(compare({"with.exr", "with.exr"}).exitCode, 0);
    EXPECT_EQ(compare({"without.exr", "without.exr"}).exitCode, 0);
    const ProgramResult result = compare({"with.exr", "without.exr"});
    EXPECT_EQ(result.exitCode, 1) << result.out;
    EXPECT_NE(result.out.find("relMSE of glow.A"), std::string::npos) << result.out;
}

TEST_F(CompareAlpha, PixelThatDiffersMostIsNamed) {
    std::vector<float> hole = kOpaque;
    for (int x = 3; x < 8; ++x)
        hole[size_t{5} * kSide + static_cast<size_t>(x)] = 0.5f;
    hole[size_t{5} * kSide + 7] = 0.0f;
    writeGrey("plain.exr", {});
    writeGrey("hole.exr", hole);
    const ProgramResult result = compare({"hole.exr", "plain.exr", "--threshold", "0.001"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.out.find("furthest: pixel 7, 5"), std::string::npos) << result.out;
}

TEST_F(CompareAlpha, OpaquePngIsLikeOneWithoutAlpha) {
    std::vector<uint32_t> pixels(size_t{kSide} * kSide, 0xff808080u);
    writePng(folder_ / "a.png", kSide, kSide, pixels);
    const ProgramResult result = compare({"a.png", "a.png", "--json"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_FALSE(json::parse(result.out).contains("layers"));
}

} // namespace
} // namespace lavalight
