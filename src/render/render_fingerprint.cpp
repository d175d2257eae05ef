#include "render/render_fingerprint.h"

#include <string>
#include <string_view>
#include <vector>

#include "base/content_hash.h"
#include "hosted/host_rays.h"

namespace lavalight {

namespace {

template <typename... Values>
std::string hashOf(const Values&... values) {
    ContentHash hash;
    (hash.add(std::vector<Values>{values}), ...);
    return hash.text();
}

std::string shadersOf(const Renderer& renderer) {
    ContentHash hash;
    for (const auto& [name, kernel] : renderer.kernels().all()) {
        hash.add(name);
        hash.add(kernel.code().content);
    }
    if (renderer.settings().work.schedule == Schedule::hosted) // the host runs what the build embedded
        for (const std::string_view kernel : kTracingKernels)
            hash.add(embeddedKernel(kernel).content);
    hash.add(renderer.scene().albedoTable().kernelContent);
    return hash.text();
}

} // namespace

Fingerprints fingerprintsOf(const Renderer& renderer) {
    const FrameParameters& f = renderer.frame();
    Fingerprints parts = renderer.scene().fingerprints();
    parts.emplace_back("environment",
                       hashOf(f.environment, f.environmentLight, f.environmentRotation, f.environmentWidth,
                              f.environmentHeight, f.firstLightColumn, f.lightColumns, f.hasBackground,
                              f.background, f.sunDirection, f.sunRadiance, f.sunSize, f.sunShare));
    parts.emplace_back("view", hashOf(f.cameraPosition, f.projection, f.cameraRight, f.cameraUp,
                                      f.cameraForward, f.axisX, f.axisY, f.lensRadius, f.focusDistance,
                                      f.clipNear, f.clipDepth, f.sceneCenter, f.sceneRadius));
    if (f.catchesShadows != 0)
        parts.emplace_back("ground", hashOf(f.groundHeight));
    parts.emplace_back("shaders", shadersOf(renderer));
    return parts;
}

} // namespace lavalight
