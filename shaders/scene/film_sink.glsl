// The sink of paths: adds the finished paths of a wave to the film, one invocation a pixel.
#include "lib/camera.glsl"
#include "lib/sampling/pixel_filter.glsl"
#include "scene/film.glsl"
#include "scene/path_layers.glsl"
#include "scene/tally.glsl"
#include "scene/wave.glsl"

// Kernels for films without layers leave out their code, which would be much to compile: kSinkHasLayers is theirs to declare.
#define SINK_HAS(plane) ((kSinkHasLayers || (plane) <= kCoveragePlane) && FILM_HAS(plane))

layout(set = 0, binding = BINDING_TRIANGLE_LAYERS, std430) readonly buffer Triangles { TriangleLayers triangles[]; };

layout(set = 0, binding = BINDING_SAMPLE_SURFACES, std430) writeonly buffer Surfaces { uint surfaces[]; };

vec3 cornerInNextFrame(TriangleLayers triangle, uint corner) {
    return vec3(triangle.next[3u * corner], triangle.next[3u * corner + 1u], triangle.next[3u * corner + 2u]);
}

vec2 uvOf(PathLayers seen) {
    if (!isSurface(seen.surface))
        return vec2(0.0);
    const TriangleLayers triangle = triangles[attributeIndex(seen.surface)];
    return (1.0 - seen.b1 - seen.b2) * triangle.uv0 + seen.b1 * triangle.uv1 + seen.b2 * triangle.uv2;
}

vec2 motionOf(PathLayers seen) {
    if (!isSurface(seen.surface))
        return vec2(0.0);
    const TriangleLayers triangle = triangles[attributeIndex(seen.surface)];
    const vec3 next = (1.0 - seen.b1 - seen.b2) * cornerInNextFrame(triangle, 0u) +
                      seen.b1 * cornerInNextFrame(triangle, 1u) + seen.b2 * cornerInNextFrame(triangle, 2u);
    return pixelMotion(frame, seen.position, next);
}

vec3 directIn(uint slot) {
    return layers[slot].isPastDirect != 0u ? layers[slot].direct : paths[slot].radiance;
}

// What the sample in a slot has of a plane: a line each, and the colour last. Components that the plane lacks are 0.
vec3 valueIn(uint plane, uint slot) {
    if (plane == kCoveragePlane || plane == kHitsPlane)
        return vec3(paths[slot].etaScale <= kUncovered ? 0.0 : 1.0, 0.0, 0.0);
    if (plane == kAlbedoPlane)
        return layers[slot].albedo;
    if (plane == kNormalPlane)
        return layers[slot].normal;
    if (plane == kDepthPlane)
        return vec3(layers[slot].depth, 0.0, 0.0);
    if (plane == kPositionPlane)
        return layers[slot].position;
    if (plane == kUvPlane)
        return vec3(uvOf(layers[slot]), 0.0);
    if (plane == kEmissionPlane)
        return layers[slot].emission;
    if (plane == kDirectPlane)
        return directIn(slot);
    if (plane == kIndirectPlane)
        return paths[slot].radiance - directIn(slot);
    if (plane == kMotionPlane)
        return vec3(motionOf(layers[slot]), 0.0);
    if (plane == kGuideAlbedoPlane)
        return layers[slot].guideAlbedo;
    if (plane == kGuideNormalPlane)
        return layers[slot].guideNormal;
    if (plane == kShadowPlane)
        return paths[slot].etaScale == kCaught ? vec3(1.0, paths[slot].throughput.xy) : vec3(0.0);
    if (plane == kBehindPlane)
        return paths[slot].etaScale == kCaught ? paths[slot].radiance : vec3(0.0);
    return paths[slot].radiance;
}

// A sample's value of a plane, with the weight that the pixel filter gives it. Only filters with negative lobes have weights
// other than 1.
vec3 weightedValue(uint plane, uint slot) {
    const vec3 value = valueIn(plane, slot);
    if ((kPlanesAsked & kNegativeWeights) == 0u || signOf(plane) != kWeighted)
        return value;
    return filterWeight(frame, sample2D(keyOfSlot(slot, 0u), kDimensionPixel)) * value;
}

bool isFinite(vec3 value) {
    return !any(isnan(value)) && !any(isinf(value));
}

bool hasFinitePlanes(uint slot) {
    bool finite = true;
#define CHECK_PLANE(number, name, channels, components, sign, hasSquares, isPerHit) \
    if (SINK_HAS(number)) \
        finite = finite && isFinite(valueIn(number, slot));
    FILM_PLANES(CHECK_PLANE)
    return finite;
}

// Samples are whole: NaN or infinity in one plane keeps them out of all. Those that are not get a radiance of NaN.
void markBroken(uint firstSlot) {
    for (uint slot = firstSlot; slot < firstSlot + range.sampleCount; ++slot)
        if (!hasFinitePlanes(slot))
            paths[slot].radiance = vec3(uintBitsToFloat(0x7fc00000u));
}

bool isWhole(uint slot) {
    return isFinite(paths[slot].radiance);
}

void fill(uint plane, uint firstSlot, uint pixel, inout FilmEvents events) {
    PlaneSums sums = loadSums(plane, pixel);
    const uint saturatedBefore = saturatedSums(plane, sums);
    uint dropped = 0u;
    for (uint slot = firstSlot; slot < firstSlot + range.sampleCount; ++slot) {
        if (isWhole(slot))
            addValue(plane, sums, weightedValue(plane, slot), events);
        else
            ++dropped;
    }
    events.dropped = dropped; // all planes drop the same samples
    events.saturated += saturatedSums(plane, sums) - saturatedBefore;
    if (plane == kIndirectPlane)
        sums = withSums(sums, loadSums(kColorPlane, pixel), loadSums(kDirectPlane, pixel));
    storeSums(plane, pixel, sums);
}

// Tells the host which surfaces the samples met.
void fillSurfaces(uint firstSlot) {
    for (uint slot = firstSlot; slot < firstSlot + range.sampleCount; ++slot)
        surfaces[slot] = isWhole(slot) ? layers[slot].surface.primitive : kDroppedSample;
}

void report(uint tally, uint count) {
    if (count > 0u)
        addTally(tally, count);
}

// Adds what the samples of the invocation's pixel have, exactly.
void addSamples() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= range.pixelCount)
        return;
    const uint pixel = range.firstPixel - range.bandFirstPixel + index;
    const uint firstSlot = index * range.sampleCount;
    FilmEvents events = FilmEvents(0u, 0u, 0u, 0u);
    if (kSinkHasLayers)
        markBroken(firstSlot);
#define FILL_PLANE(number, name, channels, components, sign, hasSquares, isPerHit) \
    if (SINK_HAS(number)) \
        fill(number, firstSlot, pixel, events);
    FILM_PLANES(FILL_PLANE)
    if (kSinkHasLayers && (kPlanesAsked & (kObjectIds | kMaterialIds)) != 0u)
        fillSurfaces(firstSlot);
    film[wordAt(countWordOf(kPlanesAsked), pixel)] += range.sampleCount - events.dropped;
    report(kTallyDropped, events.dropped);
    report(kTallyNegative, events.negative);
    report(kTallyLimited, events.limited);
    report(kTallySaturated, events.saturated);
}
