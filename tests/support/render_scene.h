// Renders scenes in the test's own process and says how far the result may be from what it must be.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/device.h"
#include "image/rendering.h"
#include "render/estimator_kernels.h"
#include "render/film.h"
#include "render/settings.h"
#include "scene/scene.h"

namespace lavalight::test {

struct RenderResult {
    Rendering rendering;
    FilmTallies tallies;
    std::vector<uint32_t>
        filmWords; // the exact film: the layout's words a pixel, pixels row by row from the top
};

// The schedules that the device can have.
[[nodiscard]] std::vector<Schedule> schedulesOf(const gpu::Device& device);

[[nodiscard]] RenderSettings imageSettings(uint32_t width, uint32_t height, uint32_t samples);

// All samples of the settings, seen from the scene's first camera. The driver compiles for a second or more,
// so the kernels are kept for the next render, and serve again if its settings and the scene's features are
// the same.
[[nodiscard]] RenderResult renderScene(gpu::Device& device, const Scene& scene,
                                       const RenderSettings& settings);
// The render with other kernels than those that the build embedded.
[[nodiscard]] RenderResult renderScene(gpu::Device& device, const Scene& scene,
                                       const RenderSettings& settings, const KernelSource& kernels);

// Share of the pixels that differ by more than the rounding of kernels of another shape.
[[nodiscard]] double shareThatDiffers(const Rendering& a, const Rendering& b);

// Words of the film that both films' samples together would have left behind.
[[nodiscard]] std::vector<uint32_t> sumOfFilms(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b,
                                               const FilmLayout& layout = colorLayout());

struct ImageMean {
    glm::dvec3 mean{0.0};
    glm::dvec3 standardError{0.0};
};

[[nodiscard]] ImageMean meanOf(const Rendering& rendering);

// A normal variable leaves +-4.5 with a probability of 7e-6; with fixed seeds a test passes always or never.
constexpr double kSigmas = 4.5;
// Relative error that rounding may bring into the radiance of a path of some ten vertices (2^-24 each
// operation).
constexpr double kRounding = 1e-5;

// Fails unless the image's mean is `expected` within kSigmas standard errors and rounding, no sample was
// dropped, and the standard error is below `precision` of the expected value, so that the test is as sharp as
// it claims to be.
void expectMean(const RenderResult& result, const glm::dvec3& expected, double precision);

// Fails unless every channel of every pixel is `expected` within rounding, and no sample was dropped.
void expectEveryPixel(const RenderResult& result, const glm::dvec3& expected);

// Fails unless both images may have the same mean: tile by tile, and as a whole.
void expectSameMean(const Rendering& a, const Rendering& b, uint32_t tileSize);

// Writes 0.5 + scale (a - b), as signals of a display, as a PNG into the folder for temporary files; returns
// its path.
[[nodiscard]] std::string writeDifference(const Image& a, const Image& b, float scale,
                                          const std::string& name);

} // namespace lavalight::test
