// `lavalight render`: files, metadata and reports of renders that succeed.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <sched.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "image/exr.h"
#include "support/environment_variable.h"
#include "support/run_program.h"
#include "support/running_program.h"
#include "support/same_image.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using nlohmann::json;
using test::EnvironmentVariable;
using test::ProgramResult;
using test::runLavalight;
using test::RunningProgram;
using test::TemporaryFolder;

class Render : public testing::Test {
  protected:
    // Renders two samples of the built-in scene.
    [[nodiscard]] ProgramResult render(std::vector<std::string> arguments,
                                       const std::string& size = "16x12") const {
        arguments.insert(arguments.begin(), {"render", "--size", size, "--spp", "2"});
        return runLavalight(arguments, folder_.path());
    }

    void expectSuccess(const std::vector<std::string>& arguments, const std::string& size = "16x12") const {
        const ProgramResult result = render(arguments, size);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(result.err, "");
    }

    [[nodiscard]] ExrFile image(const std::string& name) const { return readExr(folder_ / name); }

    [[nodiscard]] std::map<std::string, std::string> header(const std::string& name) const {
        const Metadata metadata = image(name).metadata;
        return {metadata.begin(), metadata.end()};
    }

    const TemporaryFolder folder_;
};

void expectEqualPixels(const ExrFile& a, const ExrFile& b) {
    EXPECT_EQ(a.radiance().pixels, b.radiance().pixels);
    EXPECT_EQ(a.variance().pixels, b.variance().pixels);
    EXPECT_EQ(a.sampleCounts, b.sampleCounts);
}

TEST_F(Render, WithoutOutputOptionsTheExrIsNamedAfterTheScene) {
    expectSuccess({});
    EXPECT_TRUE(std::filesystem::exists(folder_ / "cornell-box.exr"));
    EXPECT_EQ(folder_.count(), 1);
}

TEST_F(Render, CacheOfKernelsChangesNoBitWhateverIsInIt) {
    const EnvironmentVariable cache("LAVALIGHT_CACHE", (folder_ / "cache").string());
    const std::filesystem::path kernels = folder_ / "cache/kernels";
    const auto countFiles = [&] { return std::distance(std::filesystem::directory_iterator(kernels), {}); };
    expectSuccess({"cornell-glass", "-o", "empty.exr", "--quiet"});
    const auto files = countFiles();
    EXPECT_GT(files, 2);
    expectSuccess({"cornell-glass", "-o", "filled.exr", "--quiet"});
    EXPECT_EQ(countFiles(), files);
    for (const auto& file : std::filesystem::directory_iterator(kernels))
        std::filesystem::resize_file(file, file.file_size() / 2);
    expectSuccess({"cornell-glass", "-o", "damaged.exr", "--quiet"});
    const EnvironmentVariable off("LAVALIGHT_CACHE", "off");
    expectSuccess({"cornell-glass", "-o", "off.exr", "--quiet"});
    for (const char* name : {"filled.exr", "damaged.exr", "off.exr"})
        EXPECT_EQ(image(name).radiance().pixels, image("empty.exr").radiance().pixels) << name;
}

TEST_F(Render, PngAloneWritesNoExr) {
    expectSuccess({"--png", "only.png"});
    EXPECT_TRUE(readFile(folder_ / "only.png").starts_with("\x89PNG"));
    EXPECT_EQ(folder_.count(), 1);
}

TEST_F(Render, WritesEveryFileAskedForAndNothingElse) {
    expectSuccess({"-o", "a.exr", "--png", "b.png", "--report", "c.json"});
    for (const char* name : {"a.exr", "b.png", "c.json"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
    EXPECT_EQ(folder_.count(), 3);
}

TEST_F(Render, ImageHasTheSizeAndSamplesAskedFor) {
    expectSuccess({"-o", "a.exr"});
    const ExrFile file = image("a.exr");
    EXPECT_EQ(file.radiance().width, 16u);
    EXPECT_EQ(file.radiance().height, 12u);
    EXPECT_EQ(file.sampleCounts, std::vector<uint32_t>(16 * 12, 2));
    EXPECT_TRUE(file.hasVariance());
    EXPECT_TRUE(std::any_of(file.radiance().pixels.begin(), file.radiance().pixels.end(),
                            [](const glm::vec3& p) { return p.r > 0.0f; }));
}

TEST_F(Render, ExposureBrightensThePngAndNotTheExr) {
    expectSuccess({"-o", "a.exr", "--png", "a.png"});
    expectSuccess({"-o", "b.exr", "--png", "b.png", "--exposure", "2"});
    EXPECT_NE(readFile(folder_ / "a.png"), readFile(folder_ / "b.png"));
    expectEqualPixels(image("a.exr"), image("b.exr"));
}

TEST_F(Render, TonemapPicksTheCurveOfThePngAndLeavesTheExrAlone) {
    std::set<std::string> pictures;
    for (const char* curve : {"linear", "neutral", "agx", "aces"}) {
        expectSuccess(
            {"-o", "a.exr", "--png", "a.png", "--tonemap", curve, "--exposure", "1.5", "--report", "a.json"});
        pictures.insert(readFile(folder_ / "a.png"));
        const json png = json::parse(readFile(folder_ / "a.json")).at("png");
        EXPECT_EQ(png, (json{{"tonemap", curve}, {"exposure", 1.5}}));
    }
    EXPECT_EQ(pictures.size(), 4u);
    expectSuccess({"-o", "b.exr", "--png", "b.png", "--exposure", "1.5"});
    EXPECT_TRUE(pictures.contains(readFile(folder_ / "b.png"))); // linear is the default
    expectEqualPixels(image("a.exr"), image("b.exr"));
    expectSuccess({"-o", "c.exr", "--report", "c.json"});
    EXPECT_FALSE(json::parse(readFile(folder_ / "c.json")).contains("png"));
}

TEST_F(Render, SummaryIsOneLineOnStdout) {
    const ProgramResult result = render({});
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
    for (const char* part : {"cornell-box", "16x12", "2 samples", "bias ledger: none"})
        EXPECT_NE(result.out.find(part), std::string::npos) << part << " in " << result.out;
}

TEST_F(Render, QuietPrintsNothing) {
    const ProgramResult result = render({"--quiet", "--env", "1,1,1"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "");
}

TEST_F(Render, HeaderSaysHowTheImageCameToBe) {
    expectSuccess({"-o", "a.exr", "--seed", "9", "--mis", "balance", "--nee", "off", "--roulette", "off",
                   "--max-bounces", "7", "--env", "0.5,1,2"});
    const auto keys = header("a.exr");
    const std::map<std::string, std::string> expected{
        {"scene", "cornell-box"},      {"camera", "camera"},        {"samples-per-pixel", "2"},
        {"complete", "yes"},           {"option:size", "16x12"},    {"option:spp", "2"},
        {"option:seed", "9"},          {"option:mis", "balance"},   {"option:nee", "off"},
        {"option:roulette", "off"},    {"option:max-bounces", "7"}, {"option:env", "0.5,1,2"},
        {"option:roulette-start", "3"}};
    for (const auto& [key, value] : expected)
        EXPECT_EQ(keys.at(key), value) << key;
    for (const char* key : {"version", "device", "driver", "render-seconds"})
        EXPECT_FALSE(keys.at(key).empty()) << key;
    EXPECT_TRUE(keys.at("bias-ledger").starts_with("cut-paths: ")) << keys.at("bias-ledger");
}

TEST_F(Render, HeaderNamesTheDeviceThatDevicesLists) {
    const json devices = json::parse(runLavalight({"devices", "--json"}, folder_.path()).out);
    const json device = *std::find_if(devices.begin(), devices.end(),
                                      [](const json& candidate) { return candidate.at("refusals").empty(); });
    expectSuccess({"-o", "a.exr", "--device", device.at("index").dump()});
    EXPECT_EQ(header("a.exr").at("device"), device.at("name").get<std::string>());
    EXPECT_EQ(header("a.exr").at("driver"), device.at("driver").get<std::string>());
}

TEST_F(Render, ReportIsJsonThatAgreesWithTheImage) {
    expectSuccess({"-o", "a.exr", "--report", "a.json"});
    const json report = json::parse(readFile(folder_ / "a.json"));
    EXPECT_EQ(report.at("samples").at("total"), 16 * 12 * 2);
    EXPECT_EQ(report.at("samples").at("dropped"), 0);
    EXPECT_EQ(report.at("rays").at("camera"), 16 * 12 * 2);
    EXPECT_GT(report.at("rays").at("indirect"), 0);
    EXPECT_GT(report.at("rays").at("shadow"), 0);
    EXPECT_EQ(report.at("ledger"), json::array());
    for (const char* stage : {"load", "device", "prepare", "render", "write", "prepareBvh", "prepareKernels",
                              "processToFirstSamples"})
        EXPECT_GT(report.at("seconds").at(stage), 1e-4) << stage;
    EXPECT_GT(report.at("kernels").at("accumulate").at("dispatches"), 0);
    glm::dvec3 mean(0.0);
    for (const glm::vec3& pixel : image("a.exr").radiance().pixels)
        mean += glm::dvec3(pixel) / (16.0 * 12.0);
    for (glm::length_t c = 0; c < 3; ++c)
        EXPECT_NEAR(report.at("meanRadiance").at(static_cast<size_t>(c)).get<double>(), mean[c], 1e-6);
}

TEST_F(Render, ThreadsAreLimitedAndDecideNoBit) {
    for (const char* threads : {"1", "3"})
        ASSERT_EQ(runLavalight({"render", "cornell-glass", "--size", "48x32", "--samples", "0:8", "--threads",
                                threads, "-o", std::string(threads) + ".exr"},
                               folder_.path())
                      .exitCode,
                  0);
    test::expectSameImage(folder_ / "1.exr", folder_ / "3.exr");
    EXPECT_EQ(runLavalight({"render", "--threads", "0"}, folder_.path()).exitCode, 2);
}

TEST_F(Render, ScheduleIsChosenByNameOrByTheKindOfDevice) {
    const auto rendered = [&](const std::string& schedule) {
        // Not whole workgroups, and paths too long for one dispatch of the fused kernel.
        expectSuccess(
            {"-o", schedule + ".exr", "--report", "a.json", "--schedule", schedule, "--roulette", "off"},
            "17x11");
        return json::parse(readFile(folder_ / "a.json"));
    };
    const json wavefront = rendered("wavefront");
    for (const char* kernel : {"generate", "extend", "shade", "prepare", "connect", "accumulate"})
        EXPECT_GT(wavefront.at("kernels").at(kernel).at("dispatches"), 0) << kernel;
    const json fused = rendered("fused");
    EXPECT_EQ(fused.at("kernels").size(), 2u);
    EXPECT_GT(fused.at("kernels").at("path").at("dispatches"), 0);
    for (const char* kind : {"camera", "indirect", "shadow"})
        EXPECT_EQ(fused.at("rays").at(kind), wavefront.at("rays").at(kind)) << kind;
    expectEqualPixels(image("fused.exr"), image("wavefront.exr"));
    const json chosen = rendered("auto");
    const bool isCpu = chosen.at("device").at("type") == "CPU";
    EXPECT_EQ(chosen.at("settings").at("schedule"), isCpu ? "hosted" : "wavefront");
    EXPECT_EQ(header("auto.exr").at("option:schedule"), isCpu ? "hosted" : "wavefront");
    if (!isCpu)
        return;
    for (const char* kernel : {"hosted/camera", "hosted/scatter", "accumulate"})
        EXPECT_GT(chosen.at("kernels").at(kernel).at("dispatches"), 0) << kernel;
    for (const char* kind : {"camera", "indirect", "shadow"}) // a path may pass an edge within rounding
        EXPECT_NEAR(chosen.at("rays").at(kind).get<double>(), wavefront.at("rays").at(kind).get<double>(), 20)
            << kind;
}

// Programs that are started meanwhile have one processor.
class OneProcessor {
  public:
    OneProcessor() {
        sched_getaffinity(0, sizeof(before_), &before_);
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(sched_getcpu(), &one);
        EXPECT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
    }
    ~OneProcessor() { sched_setaffinity(0, sizeof(before_), &before_); }
    OneProcessor(const OneProcessor&) = delete;
    OneProcessor& operator=(const OneProcessor&) = delete;

  private:
    cpu_set_t before_{};
};

TEST_F(Render, WaveSizeBandsAndThreadsChangeNoBit) {
    {
        const EnvironmentVariable threads("LP_NUM_THREADS", "1"); // lavapipe's; other drivers do not look
        const OneProcessor forTheHost;
        expectSuccess({"-o", "one.exr"});
    }
    const EnvironmentVariable threads("LP_NUM_THREADS", "2");
    expectSuccess({"-o", "two.exr"});
    expectSuccess({"-o", "cut.exr", "--wave-size", "100", "--band-rows", "5"});
    expectEqualPixels(image("one.exr"), image("two.exr"));
    expectEqualPixels(image("one.exr"), image("cut.exr"));
}

TEST_F(Render, EnvironmentReplacesTheScenes) {
    expectSuccess({"-o", "dark.exr", "--max-bounces", "0"});
    expectSuccess({"-o", "sky.exr", "--max-bounces", "0", "--env", "5,6,7"}, "64x4");
    // The wide image looks past the box.
    EXPECT_EQ(image("sky.exr").radiance().at(0, 2), glm::vec3(5, 6, 7));
    EXPECT_EQ(image("dark.exr").radiance().at(0, 11), glm::vec3(0));
}

TEST_F(Render, CameraIsChosenByNameOrIndex) {
    expectSuccess({"-o", "default.exr"});
    expectSuccess({"-o", "index.exr", "--camera", "0"});
    expectSuccess({"-o", "name.exr", "--camera", "camera"});
    expectEqualPixels(image("default.exr"), image("index.exr"));
    expectEqualPixels(image("default.exr"), image("name.exr"));
}

TEST_F(Render, ValidationLayerHasNothingToSay) {
    expectSuccess({"--validate", "--mis", "off", "--band-rows", "5"});
}

TEST_F(Render, StopsAtTheTimeOrTheErrorAskedFor) {
    const auto stopped = [&](const std::vector<std::string>& stop) {
        std::vector<std::string> arguments{"render", "--size", "16x12", "-o", "a.exr"};
        arguments.insert(arguments.end(), stop.begin(), stop.end());
        const ProgramResult result = runLavalight(arguments, folder_.path());
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return header("a.exr");
    };
    auto keys = stopped({"--time", "2"});
    EXPECT_GT(std::stoul(keys.at("samples-per-pixel")), 64u); // no longer the default's
    EXPECT_LT(std::stod(keys.at("render-seconds")), 8.0);
    EXPECT_EQ(keys.at("bias-ledger"), "none");
    keys = stopped({"--target-error", "0.5"});
    EXPECT_TRUE(keys.at("bias-ledger").starts_with("stopped-on-estimate: ")) << keys.at("bias-ledger");
    keys = stopped({"--target-error", "1e-9", "--spp", "2"});
    EXPECT_EQ(keys.at("samples-per-pixel"), "2");
    EXPECT_EQ(keys.at("bias-ledger"), "none");
}

TEST_F(Render, PresetsAreStartingPoints) {
    expectSuccess({"-o", "a.exr", "--preset", "naive", "--hemisphere", "cosine"});
    const auto keys = header("a.exr");
    EXPECT_EQ(keys.at("option:nee"), "off");
    EXPECT_EQ(keys.at("option:sampler"), "independent");
    EXPECT_EQ(keys.at("option:hemisphere"), "cosine");
}

using Options = std::map<std::string, std::string>;

// "--nee on" or "as NAME, with --nee on" in the list of `lavalight presets`.
Options optionsOf(const std::string& words, const std::map<std::string, Options>& known) {
    Options options;
    if (const size_t as = words.find("as "); as != std::string::npos)
        options = known.at(words.substr(as + 3, words.find(", with") - as - 3));
    std::istringstream rest(words.substr(words.find("--")));
    for (std::string name, value; rest >> name >> value;)
        options[name] = value;
    return options;
}

TEST_F(Render, PresetsAreWhatTheirListSays) {
    const ProgramResult list = runLavalight({"presets"}, folder_.path());
    ASSERT_EQ(list.exitCode, 0) << list.err;
    std::map<std::string, Options> presets;
    std::istringstream lines(list.out);
    for (std::string meaning, sets; std::getline(lines, meaning) && std::getline(lines, sets);) {
        const std::string name = meaning.substr(0, meaning.find(' '));
        presets[name] = optionsOf(sets, presets);
        std::vector<std::string> words = {"-o", "options.exr"};
        for (const auto& [option, value] : presets[name])
            words.insert(words.end(), {option, value});
        expectSuccess(words);
        expectSuccess({"-o", "preset.exr", "--preset", name});
        expectEqualPixels(image("preset.exr"), image("options.exr"));
    }
    EXPECT_EQ(presets.size(), 6u);
}

TEST_F(Render, InterruptionWritesTheImageSoFar) {
    const uint32_t asked = 1'000'000;
    RunningProgram program(
        {"render", "--size", "32x24", "--spp", std::to_string(asked), "-o", "a.exr", "--report", "a.json"},
        folder_.path());
    const ProgramResult result = program.interrupt();
    EXPECT_EQ(result.exitCode, 130) << result.err;
    EXPECT_EQ(folder_.count(), 2); // nothing half-written
    const std::vector<uint32_t> counts = image("a.exr").sampleCounts;
    EXPECT_GT(*std::max_element(counts.begin(), counts.end()), 0u);
    EXPECT_LT(*std::max_element(counts.begin(), counts.end()), asked);
    EXPECT_EQ(header("a.exr").at("complete"), "no, interrupted");
    EXPECT_EQ(header("a.exr").at("option:spp"), "1000000");
    EXPECT_EQ(json::parse(readFile(folder_ / "a.json")).at("complete"), false);
}

// Mesa 25 keeps texture code apart from kernels, and would call that of the box in the kernel of glass.
TEST_F(Render, WidthsOfLavapipesVectorsDoNotShareCode) {
    const auto draw = [&](const std::string& scene, const std::string& bits, const std::string& cache) {
        const EnvironmentVariable folder("MESA_SHADER_CACHE_DIR", (folder_ / cache).string());
        const EnvironmentVariable width("LP_NATIVE_VECTOR_WIDTH", bits);
        expectSuccess({scene, "--schedule", "fused", "-o", cache + ".exr"}, "32x24");
        EXPECT_FALSE(std::filesystem::is_empty(folder_ / cache / ("lavapipe-" + bits + "-bits"))) << scene;
    };
    draw("cornell-glass", "256", "fresh");
    draw("cornell-box", "128", "used");
    draw("cornell-glass", "256", "used");
    expectEqualPixels(image("used.exr"), image("fresh.exr"));
}

} // namespace
} // namespace lavalight
