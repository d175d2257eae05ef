// A render that is cut in two at any wave, and joined or continued, has the bits of one that was not.
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "render/render_fingerprint.h"
#include "render/renderer.h"
#include "session/builtin.h"
#include "support/render_scene.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

class Continuation : public DeviceTest {
  protected:
    // 40 x 36 pixels, 17 samples: neither waves, bands nor passes divide them evenly.
    [[nodiscard]] static RenderSettings baseSettings() {
        RenderSettings settings;
        settings.image.width = 40;
        settings.image.height = 36;
        settings.stop.samples = 17;
        settings.work.waveSize = 4096;
        settings.estimator.maxBounces = 3; // so that paths are cut, and tallied
        return settings;
    }

    // What `use` makes of a renderer. Kernels that serve again are compiled once.
    template <typename Use>
    auto with(const RenderSettings& settings, const Use& use) {
        const Camera& camera = scene_.cameras.front();
        auto renderer =
            kernels_ ? std::make_unique<Renderer>(device(), scene_, camera, settings, std::move(*kernels_))
                     : std::make_unique<Renderer>(device(), scene_, camera, settings);
        auto result = use(*renderer);
        kernels_ = renderer->releaseKernels();
        return result;
    }

    [[nodiscard]] RawFilm filmOf(const RenderSettings& settings) {
        return with(settings, [](Renderer& renderer) {
            renderer.render([](double) { return true; });
            return renderer.film().read();
        });
    }

    struct Cut {
        FilmProgress progress;
        RawFilm film;
    };
    // After that many waves.
    [[nodiscard]] Cut cutAfter(const RenderSettings& settings, int waves) {
        return with(settings, [&](Renderer& renderer) {
            renderer.render([&](double) { return --waves > 0; });
            return Cut{renderer.progress(), renderer.film().read()};
        });
    }
    [[nodiscard]] RawFilm continued(const Cut& cut, const RenderSettings& settings) {
        return with(settings, [&](Renderer& renderer) {
            renderer.continueFrom(cut.progress, cut.film);
            renderer.render([](double) { return true; });
            return renderer.film().read();
        });
    }

    const Scene scene_ = loadScene("cornell-box");
    std::optional<EstimatorKernels> kernels_;
};

void expectEqual(const RawFilm& a, const RawFilm& b) {
    EXPECT_TRUE(a.words == b.words);
    EXPECT_EQ(a.tallies, b.tallies);
}

TEST_F(Continuation, FilmsOfRangesAddUpToTheWhole) {
    for (const Sampler sampler : {Sampler::sobol, Sampler::independent})
        for (const Schedule schedule : schedulesOf(device())) {
            RenderSettings settings = baseSettings();
            settings.estimator.sampler = sampler;
            settings.work.schedule = schedule;
            const RawFilm whole = filmOf(settings);
            EXPECT_GT(whole.tallies[kTallyCutPaths], 0u);
            for (const uint32_t split : {1u, 8u, 16u}) {
                RenderSettings part = settings;
                part.stop.samples = split;
                part.work.bandRows = 7;
                RawFilm sum = filmOf(part);
                part.image.firstSample = split;
                part.stop.samples = settings.stop.samples - split;
                part.work.waveSize = 1000;
                add(sum, filmOf(part));
                expectEqual(sum, whole);
            }
        }
}

TEST_F(Continuation, StartsAtAnyWaveOfAnyBand) {
    for (const Schedule schedule : schedulesOf(device())) {
        RenderSettings settings = baseSettings();
        settings.work.schedule = schedule;
        const RawFilm whole = filmOf(settings);
        settings.work.bandRows =
            7; // six waves a pass of 16 samples, and then one of the last sample each band
        for (const int waves : {1, 2, 5, 6, 7, 11}) {
            const Cut cut = cutAfter(settings, waves);
            EXPECT_LT(cut.progress.samples, settings.stop.samples);
            expectEqual(continued(cut, settings), whole);
        }
    }
}

TEST_F(Continuation, WavesAndBandsMayBeOtherOnesThanBefore) {
    RenderSettings settings = baseSettings();
    const RawFilm whole = filmOf(settings);
    settings.work.bandRows = 7;
    const Cut cut = cutAfter(settings, 4);
    EXPECT_GT(cut.progress.passPixels, 0u);
    for (const uint32_t rows : {1u, 5u, 36u})
        for (const uint32_t waveSize : {1000u, 65536u}) {
            settings.work.bandRows = rows;
            settings.work.waveSize = waveSize;
            expectEqual(continued(cut, settings), whole);
        }
}

TEST_F(Continuation, MayTakeMoreSamplesThanWereAskedForBefore) {
    RenderSettings settings = baseSettings();
    const RawFilm whole = filmOf(settings);
    settings.stop.samples = 5;
    const Cut all = cutAfter(settings, 1000);
    EXPECT_EQ(all.progress, (FilmProgress{5, 0, 0}));
    settings.stop.samples = 17;
    expectEqual(continued(all, settings), whole);
}

// The error is estimated at the ends of passes, the one where it is continued among them.
TEST_F(Continuation, StopsAtTheSameEstimateOfTheError) {
    RenderSettings settings = baseSettings();
    settings.stop.samples = 1000;
    settings.stop.targetError = 0.05;
    int waves = 0;
    const RawFilm whole = with(settings, [&](Renderer& renderer) {
        EXPECT_EQ(renderer.render([&](double) { return ++waves > 0; }), StopReason::targetError);
        return renderer.film().read();
    });
    for (const int cutAt : {1, waves / 2, waves})
        expectEqual(continued(cutAfter(settings, cutAt), settings), whole);
}

std::string partOf(const Fingerprints& fingerprints, const std::string& part) {
    for (const auto& [name, hash] : fingerprints)
        if (name == part)
            return hash;
    return {};
}

TEST_F(Continuation, FingerprintsAreThoseOfWhatChanged) {
    const auto fingerprintsWith = [&](const std::function<void(Scene&)>& change) {
        Scene scene = scene_;
        change(scene);
        const Renderer renderer(device(), scene, scene.cameras.front(), baseSettings());
        return fingerprintsOf(renderer);
    };
    const Fingerprints before = fingerprintsWith([](Scene&) {});
    EXPECT_EQ(before, fingerprintsWith([](Scene& scene) { scene.source = "another name"; }));
    const auto expectChange = [&](const std::string& part, const std::function<void(Scene&)>& change) {
        const Fingerprints after = fingerprintsWith(change);
        EXPECT_NE(partOf(before, part), partOf(after, part)) << part;
        EXPECT_EQ(partOf(before, "shaders"), partOf(after, "shaders"));
    };
    expectChange("geometry", [](Scene& scene) { scene.meshes.front().positions.front().x += 0.001f; });
    expectChange("materials", [](Scene& scene) { scene.materials.front().baseColor.x *= 0.99f; });
    expectChange("environment", [](Scene& scene) { scene.environment.x = 0.5f; });
    expectChange("lights", [](Scene& scene) { scene.punctualLights.emplace_back(); });
    expectChange("view", [](Scene& scene) { scene.cameras.front().position.x += 0.001f; });
    expectChange("view", [](Scene& scene) { scene.cameras.front().zfar = 1.0f; });
    expectChange("view", [](Scene& scene) { scene.cameras.front().znear = 100.0f; });
    const auto litTo = [&](float range) {
        return partOf(
            fingerprintsWith([&](Scene& scene) { scene.punctualLights.emplace_back().range = range; }),
            "lights");
    };
    EXPECT_NE(litTo(kNoRange), litTo(3.0f));
    // A texel that differs is a texture that differs, and nothing else.
    const auto texturedWith = [&](uint8_t red) {
        return fingerprintsWith([&](Scene& scene) {
            scene.pictures = {{"picture", 1, 1, false, {red, 2, 3, 255}}};
            Mesh& mesh = scene.meshes.front();
            mesh.uvs = {std::vector<glm::vec2>(mesh.positions.size(), glm::vec2(0.5f))};
            scene.materials[mesh.material].textures.front() = Texture{};
        });
    };
    const Fingerprints one = texturedWith(1);
    const Fingerprints other = texturedWith(2);
    for (const auto& [part, hash] : one)
        EXPECT_EQ(hash == partOf(other, part), part != "textures") << part;
}

} // namespace
} // namespace lavalight::test
