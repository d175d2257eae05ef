// The media on both sides of a vertex, and what follows from them: attenuation, indices, and where rays start.
#include "scene/dispersion.glsl"
#include "scene/interaction.glsl"
#include "scene/material.glsl"
#include "scene/media.glsl"
#include "scene/ray_start.glsl"

// The two sides of a surface that a path has met: where the path comes from, and beyond.
struct MediaSides {
    InteriorList here;
    InteriorList beyond;
    SolidRecord hereMedium;
    SolidRecord beyondMedium;
    bool touches; // boundaries of two solids coincide
};

MediaSides mediaSides(InteriorList list, uint solid, bool isFront) {
    MediaSides sides;
    sides.here = withoutRayNotes(list);
    sides.beyond = beyondBoundary(list, solid, isFront);
    sides.hereMedium = mediumOf(sides.here);
    sides.beyondMedium = mediumOf(sides.beyond);
    sides.touches = touchingSolid(list) != 0u;
    return sides;
}

bool isTransmissiveSolid(MaterialRecord m) {
    return (m.flags & kMaterialSolid) != 0u && (m.transmission > 0.0 || m.diffuseTransmission > 0.0);
}

// What is left of light on the way to the surface. An open surface of KHR_materials_volume bounds no inside that a list could
// name: a ray that reaches its back has come through it.
vec3 attenuationOf(Hit hit, Ray ray, Interaction surface, MaterialRecord material) {
    if (sceneHas(kFeatureAttenuation) && surface.solid == 0u && !surface.isFront && isTransmissiveSolid(material))
        return exp(-material.attenuation * hit.t);
    return sceneHas(kFeatureSolids) ? transmittance(mediumOf(ray.interior), hit.t) : vec3(1.0);
}

// The index behind the front of a boundary relative to the one before it, in a channel of the path.
float boundaryIndex(MediaSides media, bool isFront, uint channel) {
    const float here = channelIor(media.hereMedium.ior, media.hereMedium.dispersion, channel);
    const float beyond = channelIor(media.beyondMedium.ior, media.beyondMedium.dispersion, channel);
    if (here == beyond)
        return 1.0;
    return isFront ? relativeIndex(beyond, here) : relativeIndex(here, beyond);
}

// Chooses a channel where the surface disperses, and the material's index: at the boundary of a solid, that of the back's side
// relative to the front's.
void chooseIndex(Interaction surface, MediaSides media, SampleKey key, inout Path path, inout MaterialRecord material) {
    const bool isBoundary = sceneHas(kFeatureSolids) && surface.solid != 0u;
    uint channel = kMiddleChannel;
    if (sceneHas(kFeatureDispersion)) {
        const bool disperses = isBoundary ? max(media.hereMedium.dispersion, media.beyondMedium.dispersion) > 0.0
                                          : isDispersive(material);
        if (disperses)
            channel = chooseChannel(sample1D(key, kDimensionChannel), path);
        if (disperses && !isBoundary)
            material.ior = channelIor(material.ior, material.dispersion, channel);
    }
    if (isBoundary)
        material.ior = boundaryIndex(media, surface.isFront, channel);
}

// Whether `wi` leads to the other side than the path came from; from the smooth surface that a mesh stands for none does.
bool passes(Interaction surface, vec3 wi) {
    return !surface.isLifted && dot(wi, surface.ng) < 0.0;
}

// What is left of light over `distance` metres from the surface towards wi.
vec3 transmittanceTowards(Interaction surface, MediaSides media, vec3 wi, float distance) {
    if (!sceneHas(kFeatureSolids))
        return vec3(1.0);
    return transmittance(passes(surface, wi) ? media.beyondMedium : media.hereMedium, distance);
}

// A point on the side of wi, so far off the surface that it lies beyond all that coincides with it.
vec3 besideCoincident(Interaction surface, vec3 wi) {
    const float offset = 2.0 * nearbyDistance(surface.pError);
    return surface.p + (passes(surface, wi) ? -offset : offset) * surface.ng;
}

// Where the next ray starts. Boundaries of solids lie close to each other where panes are thin, or far from the origin: a ray
// from one starts on the very point, and where two coincide just beside both.
vec3 nextOrigin(Interaction surface, MediaSides media, vec3 wi) {
    if (!sceneHas(kFeatureSolids) || surface.solid == 0u)
        return rayOrigin(surface, wi);
    return media.touches ? besideCoincident(surface, wi) : surface.p;
}

// Where a shadow ray starts. Glass blocks it, a boundary that coincides with the surface as well.
vec3 shadowOrigin(Interaction surface, vec3 wi) {
    if (!sceneHas(kFeatureSolids) || surface.solid == 0u)
        return rayOrigin(surface, wi);
    return besideCoincident(surface, wi);
}

// A solid that the path is in, where these have become more than its list holds and nobody has counted that; else 0.
uint newlyCrowdedSolid(inout InteriorList list) {
    if ((list.notes & (kInteriorWasCrowded | kInteriorIsCounted)) != kInteriorWasCrowded)
        return 0u;
    list.notes |= kInteriorIsCounted;
    return interiorAt(list, 0u);
}
