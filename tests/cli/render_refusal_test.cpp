// `lavalight render` where it cannot: one clear line, the right exit code, no file left behind.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "base/file.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "unit/gltf/builder.h"

namespace lavalight {
namespace {

using test::GltfBuilder;
using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

class RenderRefusal : public testing::Test {
  protected:
    void write(const std::string& name, const std::string& bytes) const {
        writeFileAtomically(folder_ / name, bytes);
    }

    // The one line on stderr must hold `part`: the option or file it is about.
    void expectRefusal(std::vector<std::string> arguments, int exitCode, const std::string& part) const {
        const long filesBefore = folder_.count();
        std::string words;
        for (const std::string& argument : arguments)
            words += " " + argument;
        SCOPED_TRACE("render" + words);
        arguments.insert(arguments.begin(), "render");
        const ProgramResult result = runLavalight(arguments, folder_.path());
        EXPECT_EQ(result.exitCode, exitCode);
        EXPECT_EQ(result.out, "");
        EXPECT_TRUE(result.err.starts_with("lavalight: error: ")) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_EQ(folder_.count(), filesBefore) << "a file was left behind";
    }

    void expectSceneRefusal(const std::string& scene, const std::string& part) const {
        expectRefusal({scene, "-o", "out.exr", "--size", "8x8"}, kFailed, part);
    }

    const TemporaryFolder folder_;
};

GltfBuilder triangleFile() {
    GltfBuilder gltf;
    gltf.addNode({{"mesh", gltf.addTriangle()}});
    gltf.json["scenes"] = {{{"nodes", {0}}}};
    gltf.json["scene"] = 0;
    return gltf;
}

TEST_F(RenderRefusal, SceneThatIsNoFile) {
    expectSceneRefusal("none.glb", "none.glb");
    expectSceneRefusal("cornell-bx", "cornell-bx");
    expectSceneRefusal(".", "directory");
    expectSceneRefusal("", "a scene without a name");
}

TEST_F(RenderRefusal, SceneThatIsNoGltf) {
    write("empty.glb", "");
    write("empty.gltf", "");
    write("text.glb", "This is a text.\n");
    write("text.gltf", "This is a text.\n");
    for (const char* name : {"empty.glb", "empty.gltf", "text.glb", "text.gltf"})
        expectSceneRefusal(name, name);
}

TEST_F(RenderRefusal, SceneThatEndsEarly) {
    const std::string whole = triangleFile().glb();
    write("whole.glb", whole);
    EXPECT_EQ(runLavalight({"render", "whole.glb", "--size", "8x8", "--spp", "1"}, folder_.path()).exitCode,
              0);
    for (const size_t bytes :
         {size_t{3}, size_t{11}, size_t{12}, size_t{19}, whole.size() / 2, whole.size() - 1}) {
        write("cut.glb", whole.substr(0, bytes));
        expectSceneRefusal("cut.glb", "cut.glb");
    }
}

TEST_F(RenderRefusal, SceneWhoseBufferIsMissing) {
    GltfBuilder gltf = triangleFile();
    gltf.json["buffers"] = {{{"byteLength", gltf.bytes.size()}, {"uri", "far-away.bin"}}};
    write("scene.gltf", gltf.json.dump());
    expectSceneRefusal("scene.gltf", "far-away.bin");
}

TEST_F(RenderRefusal, SceneWhoseAccessorIsOutOfRange) {
    GltfBuilder gltf = triangleFile();
    gltf.json["accessors"][0]["count"] = 1000;
    write("scene.glb", gltf.glb());
    expectSceneRefusal("scene.glb", "accessor");
}

TEST_F(RenderRefusal, SceneWhoseNodesRunInACircle) {
    GltfBuilder gltf = triangleFile();
    gltf.json["nodes"][0]["children"] = {1};
    gltf.addNode({{"children", {0}}});
    write("scene.glb", gltf.glb());
    expectSceneRefusal("scene.glb", "node");
}

TEST_F(RenderRefusal, SizesThatCannotBe) {
    for (const char* size : {"0x10", "10x0", "100000x10", "10x100000", "16385x1", "10", "10x", "x10",
                             "10x10x10", "-1x10", "a x b"})
        expectRefusal({"--size", size}, kWrongUsage, "--size");
}

TEST_F(RenderRefusal, EnvironmentsThatCannotBe) {
    for (const char* environment :
         {"1,2", "1,2,3,4", "1,2,x", "-1,2,3", "nan,1,1", "inf,1,1", "1e99,1,1", ",,"})
        expectRefusal({std::string("--env=") + environment}, kWrongUsage, "--env");
}

TEST_F(RenderRefusal, OptionValuesThatCannotBe) {
    expectRefusal({"--mis", "best"}, kWrongUsage, "--mis: \"best\" is not one of power, balance, off");
    expectRefusal({"--mis", "1"}, kWrongUsage, "--mis"); // the number behind a name is no name
    expectRefusal({"--roulette", "russian"}, kWrongUsage, "--roulette");
    expectRefusal({"--nee", "maybe"}, kWrongUsage, "--nee");
    expectRefusal({"--require-device", "tpu"}, kWrongUsage, "tpu not in {any,cpu,gpu}");
    for (const char* option :
         {"--spp", "--seed", "--max-bounces", "--roulette-start", "--wave-size", "--band-rows"})
        for (const char* value : {"many", "-1", "5000000000", "1.5"})
            expectRefusal({option, value}, kWrongUsage, option);
    for (const char* value : {"nan", "inf", "bright"})
        expectRefusal({"--exposure", value}, kWrongUsage, "--exposure");
}

TEST_F(RenderRefusal, ToneCurvesThatThereAreNotOrThatNothingIsShownBy) {
    expectRefusal({"--png", "out.png", "--tonemap", "filmic"}, kWrongUsage,
                  "filmic not in {aces,agx,linear,neutral}");
    expectRefusal({"--tonemap", "agx"}, kWrongUsage, "--tonemap");
    expectRefusal({"--exposure", "1", "-o", "out.exr"}, kWrongUsage, "-o OUT.png");
    expectRefusal({"--tonemap", "linear", "-o", "out.exr"}, kWrongUsage, "-o OUT.png");
    expectRefusal({"--tonemap", "agx", "-o", "out.exr", "--frames", "0:2"}, kWrongUsage, "-o OUT.png");
}

TEST_F(RenderRefusal, OptionValuesOutOfRange) {
    expectRefusal({"--spp", "0"}, kWrongUsage, "--spp: 0 is outside");
    expectRefusal({"--max-bounces", "1025"}, kWrongUsage, "--max-bounces: 1025 is outside");
    expectRefusal({"--roulette-start", "0"}, kWrongUsage, "--roulette-start: 0 is outside");
    expectRefusal({"--wave-size", "63"}, kWrongUsage, "--wave-size: 63 is outside");
}

TEST_F(RenderRefusal, EstimatorsThatCannotBe) {
    for (const char* probability : {"0", "-0.5", "1.5", "nan"})
        expectRefusal({"--roulette", "constant", "--roulette-probability", probability}, kWrongUsage,
                      "--roulette-probability");
    expectRefusal({"--max-bounces", "-1"}, kWrongUsage, "--max-bounces");
    expectRefusal({"--clamp-indirect", "0"}, kWrongUsage, "--clamp-indirect");
    expectRefusal({"--time", "-1"}, kWrongUsage, "--time");
    expectRefusal({"--target-error", "-0.1"}, kWrongUsage, "--target-error");
    expectRefusal({"--preset", "best"}, kWrongUsage, "naive, cosine, nee, mis, roulette, reference");
    expectRefusal({"--mis-survival", "on"}, kWrongUsage, "--mis-survival on needs a --roulette");
    expectRefusal({"--preset", "naive", "--mis-survival", "on"}, kWrongUsage, "it is off");
}

TEST_F(RenderRefusal, WordsThatNobodyTakes) {
    expectRefusal({"--frobnicate"}, kWrongUsage, "--frobnicate");
    expectRefusal({"cornell-box", "second-scene"}, kWrongUsage, "second-scene");
    expectRefusal({"--spp"}, kWrongUsage, "--spp");
}

TEST_F(RenderRefusal, UnknownCameraIsToldTheCamerasThereAre) {
    expectRefusal({"--camera", "none"}, kWrongUsage, "0 \"camera\"");
    expectRefusal({"--camera", "1"}, kWrongUsage, "0 \"camera\"");
}

TEST_F(RenderRefusal, CamerasThatCannotBe) {
    const std::vector<std::string> good{"--look-from", "-1,2,3", "--look-at", "0,0,0"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = good;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    expectRefusal({"--look-from", "1,2,3", "--look-at", "1,2,3"}, kWrongUsage, "--look-at");
    expectRefusal({"--look-from", "1,2", "--look-at", "1,2,3"}, kWrongUsage, "--look-from");
    expectRefusal({"--look-from", "1e39,2,3", "--look-at", "1,2,3"}, kWrongUsage, "--look-from");
    expectRefusal({"--look-from", "1,2,3"}, kWrongUsage, "--look-at");
    expectRefusal({"--look-at", "1,2,3"}, kWrongUsage, "--look-from");
    expectRefusal(with({"--up", "0,0,0"}), kWrongUsage, "--up");
    expectRefusal(with({"--camera", "0"}), kWrongUsage, "--camera");
    for (const char* fov : {"0", "-10", "180", "nan"})
        expectRefusal(with({"--fov", fov}), kWrongUsage, "--fov");
    expectRefusal({"--aperture", "-0.1"}, kWrongUsage, "--aperture");
    expectRefusal({"--aperture", "0.1", "--focus", "0"}, kWrongUsage, "--focus");
    expectRefusal({"--aperture", "0.1", "--panorama"}, kWrongUsage, "--aperture");
}

TEST_F(RenderRefusal, EnvironmentMapsThatAreNone) {
    write("text.hdr", "This is a text.\n");
    write("text.exr", "This is a text.\n");
    for (const char* name : {"text.hdr", "text.exr", "none.hdr", "none.exr"})
        expectRefusal({"--env", name}, kFailed, name);
    expectRefusal({"--env", "picture.png"}, kWrongUsage, "picture.png");
    expectRefusal({"--env-rotation", "90"}, kWrongUsage, "--env");
    expectRefusal({"--env-intensity", "-1"}, kWrongUsage, "--env-intensity");
}

TEST_F(RenderRefusal, UnknownDeviceIsToldTheDevicesThereAre) {
    expectRefusal({"--device", "no-such"}, kFailed, "no-such");
    expectRefusal({"--device", "99"}, kFailed, "99");
}

TEST_F(RenderRefusal, OutputsThatCannotBeWritten) {
    expectRefusal({"-o", "none/out.exr"}, kFailed, "none/out.exr");
    expectRefusal({"--png", "none/out.png"}, kFailed, "none/out.png");
    expectRefusal({"--report", "none/out.json"}, kFailed, "none/out.json");
    std::filesystem::create_directory(folder_ / "folder.exr");
    std::filesystem::create_symlink("/dev/null", folder_ / "null.exr");
    expectRefusal({"-o", "folder.exr"}, kFailed, "directory");
    expectRefusal({"-o", "null.exr"}, kFailed, "not a regular file");
    expectRefusal({"-o", "same.exr", "--report", "same.exr"}, kWrongUsage, "same.exr");
}

} // namespace
} // namespace lavalight
