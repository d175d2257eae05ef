// What a camera path saw first: one record for each path slot, with kFeatureLayers.
#ifndef LAVALIGHT_SHARED_PATH_LAYERS_H
#define LAVALIGHT_SHARED_PATH_LAYERS_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// All 0 for a path that met nothing, but for its emission.
struct PathLayers {
    vec3 albedo;
    float depth;
    vec3 normal;
    uint isFollowed; // the path has met smooth mirrors and glass alone so far: the guides are those of the first of them
    vec3 position;
    uint unused0;
    vec3 emission;
    uint unused1;
    vec3 guideAlbedo;
    uint unused2;
    vec3 guideNormal;
    uint unused3;
};

LAVALIGHT_SHARED_END

#endif
