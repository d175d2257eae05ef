// What a live render shall show.
#pragma once

#include <memory>
#include <optional>

#include "kernels/shader_overlay.h"
#include "render/settings.h"
#include "render/tone_settings.h"
#include "scene/scene.h"

namespace lavalight {

struct LiveRequest {
    std::shared_ptr<const Scene> scene; // with its environment map
    Camera camera;
    RenderSettings settings;                // at the window's size
    std::optional<EstimatorSettings> other; // rendered beside it, for comparison
    std::shared_ptr<ShaderOverlay> shaders; // null: as built
    ToneSettings tone;
    bool isMoving = false; // a coarse picture soon, rather than a fine one later
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
