// Layers of a path: what its first surfaces are (shared/path_layers.h).
#include "lib/features.glsl"
#include "scene/frame.glsl"
#include "shared/bindings.h"
#include "shared/path_layers.h"

layout(set = 0, binding = BINDING_PATH_LAYERS, std430) buffer Layers { PathLayers layers[]; };

// Kernels of all features record layers where a render asks for them.
bool recordsLayers() {
    return sceneHas(kFeatureLayers) && frame.hasLayers != 0u;
}

// A path that has met nothing so far.
void startLayers(uint slot) {
    if (!recordsLayers())
        return;
    PathLayers none;
    none.albedo = none.normal = none.position = none.emission = none.guideAlbedo = none.guideNormal = none.direct =
        vec3(0.0);
    none.depth = none.b1 = none.b2 = 0.0;
    none.surface = kNoSurface;
    none.isFollowed = none.isPastDirect = none.unused = 0u;
    layers[slot] = none;
}
