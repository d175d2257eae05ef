// What a live render gives the window to show.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/commands.h"
#include "inspect/path_inspector.h"
#include "render/wave_renderer.h"
#include "scene/scene.h"

namespace lavalight {

// sRGB-encoded pixels, rows from the top, 4 bytes a pixel: R, G, B, 255.
struct LivePicture {
    uint32_t width = 0; // less than the window's while the camera moves
    uint32_t height = 0;
    std::vector<uint32_t> pixels;
};

struct LiveStatistics {
    uint32_t samples = 0; // samples of every pixel
    double seconds = 0.0; // time that these samples took
    uint64_t paths = 0;   // paths begun so far
    RayCounts rays;
    double error = -1.0; // estimated relMSE; negative: not known yet
    gpu::KernelTimes kernels;
    std::vector<uint64_t> raysPerBounce; // queue lengths; empty: these kernels have no queues
    uint32_t denoisedSamples = 0;        // samples of the denoised picture that is shown; 0: none is
    float exposure = 0.0f;               // stops that the picture is shown with
};

// One of the images rendered side by side.
struct LiveView {
    LivePicture picture;
    LiveStatistics statistics;
};

// A pixel, and one of its paths.
struct PixelInspection {
    std::shared_ptr<const Scene> scene; // the scene that was rendered: its indices are those of the path
    glm::uvec2 pixel{0};
    glm::vec3 radiance{0.0f}; // mean of its samples
    glm::vec3 variance{0.0f}; // variance of that mean
    uint32_t count = 0;       // number of samples
    uint32_t sample = 0;      // the sample whose path this is
    TracedPath path;
};

} // namespace lavalight
