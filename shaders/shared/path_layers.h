// What a camera path saw first: one record for each path slot, with kFeatureLayers.
#ifndef LAVALIGHT_SHARED_PATH_LAYERS_H
#define LAVALIGHT_SHARED_PATH_LAYERS_H

#include "shared/surface_id.h"
#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// All 0 for a path that met nothing, but for its surface, which is kNoSurface, and its emission.
struct PathLayers {
    vec3 albedo;
    float depth;
    vec3 normal;
    uint isFollowed; // the path has met smooth mirrors and glass alone so far: the guides are those of the first of them
    vec3 position;
    SurfaceId surface;
    vec3 emission;
    uint isPastDirect; // the path went on beyond its second vertex; else all that it found is direct
    vec3 guideAlbedo;
    float b1; // barycentrics on the surface
    vec3 guideNormal;
    float b2;
    vec3 direct;
    uint unused;
};

// What layers show of a triangle beyond its geometry: a record for each, in the order of surfaces.
struct TriangleLayers {
    vec2 uv0;
    vec2 uv1;
    vec2 uv2;
    float next[9]; // positions of the corners in the next frame, from the scene's origin
    uint unused;
};

LAVALIGHT_SHARED_END

#endif
