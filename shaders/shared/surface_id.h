// What a hit names: a triangle of the scene, in every kernel and on the host.
#ifndef LAVALIGHT_SHARED_SURFACE_ID_H
#define LAVALIGHT_SHARED_SURFACE_ID_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// A triangle of an instance. All meshes are baked into the world today, so the instance is 0 and takes no memory: scenes
// that have instances will need a member here, and no other use of a surface than the functions below.
struct SurfaceId {
    uint primitive; // in the scene's numbering: meshes in order, triangles in order
};
SHARED_CONST SurfaceId kNoSurface = {0xffffffffu}; // nothing was hit, or a ray starts in free space

SHARED_FUNCTION uint instanceOf(SurfaceId) {
    return 0u;
}

SHARED_FUNCTION bool isSurface(SurfaceId surface) {
    return surface.primitive != kNoSurface.primitive;
}

// A ray must not hit the surface that it starts or ends on.
SHARED_FUNCTION bool isSameSurface(SurfaceId a, SurfaceId b) {
    return a.primitive == b.primitive;
}

// Where two surfaces are hit at the same t, every accelerator answers with the one that precedes.
SHARED_FUNCTION bool precedes(SurfaceId a, SurfaceId b) {
    return a.primitive < b.primitive;
}

// Index into the arrays with an element for each triangle: normals, texture coordinates, colours, tangents.
SHARED_FUNCTION uint attributeIndex(SurfaceId surface) {
    return surface.primitive;
}

// Words that tell it from all others, for decisions taken by chance at each surface along a ray.
SHARED_FUNCTION uvec2 hashWords(SurfaceId surface) {
    return uvec2(surface.primitive, instanceOf(surface));
}

LAVALIGHT_SHARED_END

#endif
