// Where the rays of a vertex start: on the mesh, moved off it by rounding alone, or on the smooth surface that it stands for.
#include "scene/interaction.glsl"

// The point that lights are sampled from.
vec3 receivingPoint(Interaction surface) {
    return surface.isLifted ? surface.lifted : surface.p;
}

vec3 rayOrigin(Interaction surface, vec3 wi) {
    return surface.isLifted ? surface.lifted : offsetOrigin(surface.p, surface.pError, surface.ng, wi);
}

// The surface that rays from here must not hit: from the smooth surface, the triangle below may be in the way as well.
SurfaceId ignoredSurface(Interaction surface) {
    return surface.isLifted ? kNoSurface : surface.id;
}
