// Outputs never destroy inputs, and -o writes the format that its ending names.
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/os/file_lock.h"
#include "image/exr.h"
#include "image/picture.h"
#include "image/png.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "unit/gltf/builder.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;
using test::GltfBuilder;
using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;
using Words = std::vector<std::string>;

Rendering grey(float radiance) {
    Rendering rendering{Image(8, 4), Image(8, 4), std::vector<uint32_t>(32, 4)};
    for (glm::vec3& pixel : rendering.radiance().pixels)
        pixel = glm::vec3(radiance);
    return rendering;
}

// A scene as one file (s.glb) and in pieces (s.gltf, data.bin, "a b.png", spare.png, which no texture uses),
// a map, a link of each kind.
class InputSafety : public testing::Test {
  protected:
    void SetUp() override {
        GltfBuilder gltf;
        gltf.addNode({{"mesh", gltf.addTriangle()}});
        writeFileAtomically(folder_ / "s.glb", gltf.glb());
        writeFileAtomically(folder_ / "data.bin", gltf.bytes);
        gltf.json["buffers"] = {{{"byteLength", gltf.bytes.size()}, {"uri", "data.bin"}}};
        gltf.json["images"] = {{{"uri", "a%20b.png"}}, {{"uri", "./spare.png"}}};
        gltf.json["textures"] = {{{"source", 0}}};
        gltf.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        writeFileAtomically(folder_ / "s.gltf", gltf.json.dump());
        for (const char* picture : {"a b.png", "spare.png"})
            writePng(folder_ / picture, 1, 1, std::vector<uint32_t>{0xff808080u});
        writeExr(folder_ / "env.exr", grey(1.0f), {});
        writeExr(folder_ / "b.exr", grey(1.0f), {});
        fs::create_symlink("s.glb", folder_ / "soft.exr");
        fs::create_hard_link(folder_ / "s.glb", folder_ / "hard.png");
        fs::create_directory(folder_ / "sub");
    }

    [[nodiscard]] std::vector<std::pair<fs::path, std::string>> contents() const {
        std::vector<std::pair<fs::path, std::string>> all;
        for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
            all.emplace_back(entry.path(), entry.is_regular_file() ? readFile(entry.path()) : "");
        std::sort(all.begin(), all.end());
        return all;
    }

    // Exit 2 with the reason, and every file as before.
    void expectRefused(const Words& arguments, const std::string& reason) const {
        SCOPED_TRACE(testing::PrintToString(arguments));
        const auto before = contents();
        const ProgramResult result = runLavalight(arguments, folder_.path());
        EXPECT_EQ(result.exitCode, 2) << result.err;
        EXPECT_NE(result.err.find(reason), std::string::npos) << result.err;
        EXPECT_TRUE(contents() == before) << "a file was changed";
    }

    [[nodiscard]] ProgramResult render(Words arguments) const {
        arguments.insert(arguments.begin(), {"render", "--size", "8x4", "--spp", "1", "--quiet"});
        return runLavalight(arguments, folder_.path());
    }

    const TemporaryFolder folder_;
};

TEST_F(InputSafety, SceneIsNotReplacedByAnyOutputUnderAnyName) {
    fs::copy_file(folder_ / "s.glb", folder_ / "scene.exr"); // glTF is told by content
    fs::copy_file(folder_ / "s.glb", folder_ / "scene.png");
    expectRefused({"render", "scene.exr", "-o", "scene.exr"}, "it is the scene");
    expectRefused({"render", "scene.exr"}, "it is the scene"); // the default name
    expectRefused({"render", "scene.png", "-o", "scene.png"}, "it is the scene");
    expectRefused({"render", "scene.png", "--png", "scene.png"}, "it is the scene");
    expectRefused({"render", "s.glb", "--report", "s.glb"}, "it is the scene");
    expectRefused({"render", "s.glb", "--checkpoint", "s.glb"}, "it is the scene");
    expectRefused({"render", "s.glb", "--checkpoint", "s.glb", "--resume"}, "it is the scene");
    expectRefused({"render", "s.glb", "-o", "soft.exr"}, "it is the scene");
    expectRefused({"render", "s.glb", "-o", "hard.png"}, "it is the scene");
    expectRefused({"render", "soft.exr", "--report", "s.glb"}, "it is the scene");
    expectRefused({"render", "s.glb", "--report", "sub/../s.glb"}, "it is the scene");
    expectRefused({"render", "s.glb", "--report", (folder_ / "s.glb").string()}, "it is the scene");
}

TEST_F(InputSafety, BuffersPicturesAndMapsAreNotReplaced) {
    expectRefused({"render", "s.gltf", "--report", "data.bin"}, "it is a buffer or picture");
    expectRefused({"render", "s.gltf", "--png", "a b.png"}, "it is a buffer or picture");
    expectRefused({"render", "s.gltf", "-o", "a b.png"}, "it is a buffer or picture");
    expectRefused({"render", "s.gltf", "-o", "spare.png"}, "it is a buffer or picture");
    expectRefused({"render", "s.glb", "--env", "env.exr", "-o", "env.exr"}, "it is the environment map");
    expectRefused({"render", "s.glb", "--env", "env.exr", "-o", "sub/../env.exr"},
                  "it is the environment map");
    expectRefused({"render", "s.glb", "--env", "env.exr", "--checkpoint", "env.exr", "--resume"},
                  "it is the environment map");
}

TEST_F(InputSafety, ShadersAreNotReplaced) {
    ASSERT_EQ(runLavalight({"new-experiment", "mine", "lib/sampling/roulette.glsl"}, folder_.path()).exitCode,
              0);
    expectRefused({"render", "s.glb", "--shaders", "mine", "--report", "mine/lib/sampling/roulette.glsl"},
                  "it is one of the shaders");
}

TEST_F(InputSafety, NamesThatTheProgramMakesCountToo) {
    fs::copy_file(folder_ / "env.exr", folder_ / "out_0003.exr");
    expectRefused({"render", "s.glb", "--env", "out_0003.exr", "--frames", "0:9", "-o", "out.exr"},
                  "cannot write out_0003.exr: it is the environment map");
    for (const char* name :
         {"c.exr.lock", "c.exr.7-0.part"}) { // the second looks unfinished, and would be removed
        fs::copy_file(folder_ / "s.glb", folder_ / name);
        expectRefused({"render", name, "--checkpoint", "c.exr", "-o", "out.exr"}, "it is the scene");
    }
    expectRefused({"render", "s.glb", "--checkpoint", "c.exr", "--report", "c.exr.lock"},
                  "cannot hold two outputs");
    expectRefused({"render", "s.glb", "-o", "new.exr", "--report", "sub/../new.exr"},
                  "cannot hold two outputs");
}

TEST_F(InputSafety, CheckpointOfARenderUnderWayIsNotReplaced) {
    fs::copy_file(folder_ / "env.exr", folder_ / "c.exr");
    const FileLock other(folder_ / "c.exr");
    expectRefused({"render", "s.glb", "-o", "c.exr"}, "the checkpoint of a render that is under way");
    expectRefused({"render", "s.glb", "--report", "c.exr"}, "the checkpoint of a render that is under way");
}

TEST_F(InputSafety, ComparedImagesAndPartsAreNotReplaced) {
    fs::create_hard_link(folder_ / "b.exr", folder_ / "also-b.html");
    expectRefused({"compare", "env.exr", "b.exr", "--html", "env.exr"}, "it is the image");
    expectRefused({"compare", "env.exr", "b.exr", "--html", "also-b.html"}, "it is the reference");
    expectRefused({"compare", "a b.png", "spare.png", "--heatmap", "spare.png"}, "it is the reference");
    expectRefused({"compare", "env.exr", "b.exr", "--heatmap", "x.png", "--html", "./x.png"},
                  "cannot hold two outputs");
    for (const char* range : {"0:1", "1:2"})
        ASSERT_EQ(runLavalight({"render", "s.glb", "--size", "8x4", "--samples", range, "-o",
                                std::string("part") + range[0] + ".exr"},
                               folder_.path())
                      .exitCode,
                  0);
    expectRefused({"merge", "part0.exr", "part1.exr", "-o", "part0.exr"}, "it is one of the parts");
    expectRefused({"merge", "part0.exr", "part1.exr", "-o", "sub/../part1.exr"}, "it is one of the parts");
    expectRefused({"merge", "part0.exr", "part1.exr", "-o", "sum.png"}, ".exr");
}

TEST_F(InputSafety, EndingChoosesTheFormat) {
    ASSERT_EQ(render({"s.glb", "-o", "one.exr", "-o", "two.png"}).exitCode, 0);
    EXPECT_EQ(readExr(folder_ / "one.exr").radiance().width, 8u);
    EXPECT_EQ(decodePicture(readFile(folder_ / "two.png")).width, 8u);
    ASSERT_EQ(render({"-o", "three.PNG", "s.glb"}).exitCode, 0); // -o takes one word
    EXPECT_EQ(decodePicture(readFile(folder_ / "three.PNG")).width, 8u);
    EXPECT_FALSE(fs::exists(folder_ / "s.exr"));
    ASSERT_EQ(render({"s.glb", "--png", "four.png", "-o", "five.EXR", "--tonemap", "agx"}).exitCode, 0);
    EXPECT_EQ(decodePicture(readFile(folder_ / "four.png")).width, 8u);
    EXPECT_EQ(readExr(folder_ / "five.EXR").radiance().width, 8u);
}

TEST_F(InputSafety, OtherEndingsAreRefusedWithTheListOfThose) {
    for (const char* name : {"out", "out.jpg", "out.exr.tiff", "exr", "out.", ".exr"})
        expectRefused({"render", "s.glb", "-o", name}, "give .exr (radiance) or .png (to look at)");
    expectRefused({"render", "s.glb", "--png", "out.jpg"}, "give .exr (radiance) or .png (to look at)");
    expectRefused({"render", "s.glb", "--png", "out.exr"}, "--png: out.exr");
    expectRefused({"render", "s.glb", "-o", "a.exr", "-o", "b.exr"}, "both .exr files");
    expectRefused({"render", "s.glb", "-o", "a.png", "--png", "b.png"}, "both .png files");
}

TEST_F(InputSafety, OutputThatIsNoInputReplacesWhatIsThere) {
    EXPECT_EQ(render({"s.glb", "-o", "b.exr"}).exitCode, 0);
    EXPECT_EQ(render({"s.glb", "--png", "spare.png"}).exitCode, 0); // s.gltf's
    EXPECT_EQ(render({"s.glb", "--checkpoint", "c.exr", "-o", "b.exr"}).exitCode, 0);
    EXPECT_EQ(render({"s.glb", "--checkpoint", "c.exr", "--resume", "-o", "b.exr"}).exitCode, 0);
}

} // namespace
} // namespace lavalight
