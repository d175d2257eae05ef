// What a live render shall show.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "denoise/denoiser.h"
#include "kernels/shader_overlay.h"
#include "render/settings.h"
#include "render/tone_settings.h"
#include "scene/scene.h"
#include "view/shown_layer.h"

namespace lavalight {

struct LiveRequest {
    std::shared_ptr<const Scene> scene; // the scene with its environment map
    Camera camera;
    RenderSettings settings;                // at the window's size, with the planes of `shown` and `asked`
    std::optional<EstimatorSettings> other; // rendered beside it, with isSplit
    std::shared_ptr<ShaderOverlay> shaders; // null: as built
    ToneSettings tone;
    bool isMoving = false;       // a coarse picture soon, rather than a fine one later
    bool isSplit = false;        // two pictures are shown, of one image where there is no `other`
    bool exposesByImage = false; // the image settles tone.exposure
    std::array<ShownLayer, 2> shown{};
    DenoiseQuality quality = DenoiseQuality::fast;
    uint32_t asked = 0; // layers of a saved EXR (OutputStyle::layers)
    bool operator==(const LiveRequest&) const = default;
};

// What a change of the request costs.
enum class Restart {
    nothing, // the image goes on; at most it is shown otherwise
    image,   // the image starts from its first sample; maybe with other kernels
    scene    // the scene goes to the device anew
};

// What it costs the image of `a` that `b` is asked for.
[[nodiscard]] Restart restartsImage(const LiveRequest& a, const LiveRequest& b);

} // namespace lavalight
