#version 460
// Adds the finished paths of the wave to the film, one invocation a pixel, exactly.
#include "scene/film.glsl"
#include "scene/path_layers.glsl"
#include "scene/tally.glsl"
#include "scene/wave.glsl"

layout(local_size_x = 64) in;

// What the sample in a slot has of a plane: a line each, and the colour last. Components that the plane lacks are 0.
vec3 valueIn(uint plane, uint slot) {
    if (plane == kCoveragePlane || plane == kHitsPlane)
        return vec3(paths[slot].etaScale == kUncovered ? 0.0 : 1.0, 0.0, 0.0);
    if (plane == kAlbedoPlane)
        return layers[slot].albedo;
    if (plane == kNormalPlane)
        return layers[slot].normal;
    if (plane == kDepthPlane)
        return vec3(layers[slot].depth, 0.0, 0.0);
    if (plane == kPositionPlane)
        return layers[slot].position;
    if (plane == kEmissionPlane)
        return layers[slot].emission;
    if (plane == kGuideAlbedoPlane)
        return layers[slot].guideAlbedo;
    if (plane == kGuideNormalPlane)
        return layers[slot].guideNormal;
    return paths[slot].radiance;
}

bool isFinite(vec3 value) {
    return !any(isnan(value)) && !any(isinf(value));
}

// Samples are whole: NaN or infinity in one plane keeps them out of all.
bool isWhole(uint slot) {
    bool finite = true;
#define CHECK_PLANE(number, name, channels, components, isSigned, hasSquares, isPerHit) \
    if (filmHas(number)) \
        finite = finite && isFinite(valueIn(number, slot));
    FILM_PLANES(CHECK_PLANE)
    return finite;
}

void fill(uint plane, uint firstSlot, uint pixel, inout FilmEvents events) {
    PlaneSums sums = loadSums(plane, pixel);
    const uint saturatedBefore = saturatedSums(plane, sums);
    uint dropped = 0u;
    for (uint slot = firstSlot; slot < firstSlot + range.sampleCount; ++slot) {
        if (isWhole(slot))
            addValue(plane, sums, valueIn(plane, slot), events);
        else
            ++dropped;
    }
    events.dropped = dropped; // all planes drop the same samples
    events.saturated += saturatedSums(plane, sums) - saturatedBefore;
    storeSums(plane, pixel, sums);
}

void report(uint tally, uint count) {
    if (count > 0u)
        addTally(tally, count);
}

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= range.pixelCount)
        return;
    const uint pixel = range.firstPixel - range.bandFirstPixel + index;
    const uint firstSlot = index * range.sampleCount;
    FilmEvents events = FilmEvents(0u, 0u, 0u, 0u);
#define FILL_PLANE(number, name, channels, components, isSigned, hasSquares, isPerHit) \
    if (filmHas(number)) \
        fill(number, firstSlot, pixel, events);
    FILM_PLANES(FILL_PLANE)
    film[wordAt(countWordOf(kPlanesAsked), pixel)] += range.sampleCount - events.dropped;
    report(kTallyDropped, events.dropped);
    report(kTallyNegative, events.negative);
    report(kTallyLimited, events.limited);
    report(kTallySaturated, events.saturated);
}
