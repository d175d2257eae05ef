// Estimators broken on purpose: the test that compares means has to notice, or it proves nothing.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "gpu/shader_build.h"
#include "scene/builtin.h"
#include "support/mean_test.h"
#include "support/render_scene.h"
#include "support/temporary_folder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

namespace fs = std::filesystem;

// A kernel from a copy of the sources in which `from`, found exactly once in scene/path_vertex.glsl, reads `to`.
gpu::KernelCode brokenKernel(std::string_view name, const std::string& from, const std::string& to) {
    const TemporaryFolder folder;
    fs::copy(fs::path(LAVALIGHT_SOURCE_DIR) / "shaders", folder.path(),
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    const fs::path file = folder.path() / "scene/path_vertex.glsl";
    std::stringstream buffer;
    buffer << std::ifstream(file).rdbuf();
    std::string source = buffer.str();
    const size_t at = source.find(from);
    if (at == std::string::npos || source.find(from, at + 1) != std::string::npos)
        throw std::runtime_error("path_vertex.glsl does not hold exactly one \"" + from + "\"");
    source.replace(at, from.size(), to);
    std::ofstream(file) << source;
    return gpu::compileKernel(folder.path() / "kernels" / (std::string(name) + ".comp"), folder.path());
}

class BrokenEstimatorTest : public DeviceTest {
  protected:
    void expectNotice(const std::string& sceneName, const std::string& from, const std::string& to,
                      uint32_t samples = 1024) {
        const Scene scene = loadScene(sceneName);
        RenderSettings settings = imageSettings(32, 32, samples);
        const RenderResult sound = renderScene(device(), scene, settings);
        settings.estimator.seed = 1;
        const RenderResult broken = renderScene(device(), scene, settings, [&](std::string_view name) {
            return name == "accumulate" ? embeddedKernel(name) : brokenKernel(name, from, to);
        });
        const MeanComparison comparison = compareMeans(broken.rendering, sound.rendering);
        std::cout << sceneName << ": " << comparison.text() << "\n";
        EXPECT_FALSE(comparison.same()) << comparison.text();
    }
};

TEST_F(BrokenEstimatorTest, RouletteThatDoesNotMakeUpForTheDeadIsNoticed) {
    expectNotice("cornell-box", "path.throughput /= survival;", "");
}

TEST_F(BrokenEstimatorTest, ADensityOffByFivePercentIsNoticed) {
    expectNotice("cornell-box", "(weight / light.pdf)", "(weight / (1.05 * light.pdf))");
}

TEST_F(BrokenEstimatorTest, WeightsThatDoNotSumToOneAreNoticed) {
    expectNotice("veach-mis", "misWeight(kMis, bsdfPdf, lightPdf)",
                 "misWeight(kMisBalance, bsdfPdf, lightPdf)", 4096);
}

TEST_F(BrokenEstimatorTest, LightThatCountsTwiceIsNoticed) {
    expectNotice("cornell-box", "kMis == kMisOff ? 0.0 : misWeight(kMis, bsdfPdf, lightPdf)", "1.0");
}

} // namespace
} // namespace lavalight::test
