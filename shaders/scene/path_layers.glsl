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
    none.albedo = none.normal = none.position = none.emission = none.guideAlbedo = none.guideNormal = vec3(0.0);
    none.depth = 0.0;
    none.isFollowed = 0u;
    none.unused0 = none.unused1 = none.unused2 = none.unused3 = 0u;
    layers[slot] = none;
}
