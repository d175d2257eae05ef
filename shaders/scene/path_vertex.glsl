// The parts of a path's vertex: what lights send it directly, and where the path goes on. scene/scatter.glsl puts them together.
#include "lib/sampling/mis.glsl"
#include "lib/math/onb.glsl"
#include "lib/sampling/roulette.glsl"
#include "scene/coated_emission.glsl"
#include "scene/frame.glsl"
#include "scene/interaction.glsl"
#include "scene/light.glsl"
#include "scene/material.glsl"
#include "scene/media_sides.glsl"
#include "scene/textured_material.glsl"

// A vertex of the path with all that its parts ask for.
struct Vertex {
    Interaction surface;
    Surface bsdf;
    Basis basis;
    vec3 wo;        // local
    uint receiver;  // packed, for the light tree
    float survival; // probability by albedo, known before a direction is drawn
    SampleKey key;
    MediaSides media; // with kFeatureSolids
};

// What comes from beyond the first vertex, limited if --clamp-indirect asks for it; `scatterings` before it is seen.
vec3 clamped(vec3 radiance, uint scatterings) {
    const float largest = max(radiance.x, max(radiance.y, radiance.z));
    return scatterings > 1u && largest > frame.clampIndirect ? radiance * (frame.clampIndirect / largest) : radiance;
}

// How much of a light that this path's BSDF ray found counts, next to what NEE found at the previous vertex, which finds
// that direction with density lightPdf.
float foundLightWeight(float bsdfPdf, float lightPdf) {
    if (bsdfPdf == 0.0 || kNee == 0u || lightPdf == 0.0)
        return 1.0;
    return kMis == kMisOff ? 0.0 : misWeight(kMis, bsdfPdf, lightPdf);
}

float hitLightPdf(Interaction surface, Hit hit, Ray ray) {
    if (!sceneHas(kFeatureTriangleLights) || surface.emitter == kNoEmitter || kNee == 0u)
        return 0.0;
    const Receiver receiver = unpackReceiver(ray.origin, ray.receiver);
    return lightPmf(frame, receiver, surface.emitter) *
           triangleLightPdf(loadTriangle(hit.record), ray.origin, surface.area, hit.t * hit.t,
                            dot(surface.ng, ray.direction));
}

float missLightPdf(Ray ray) {
    if (!sceneHas(kFeatureEnvironmentLight) || kNee == 0u)
        return 0.0;
    return environmentPmf(frame) * environmentPdf(frame, ray.direction, ray.originCosine);
}

// n and ng must agree about the side of wi; from the smooth surface n alone decides, and the mesh may be in the way.
bool isSameSide(Vertex v, vec3 wi, float localZ) {
    return v.surface.isLifted ? localZ > 0.0 : (dot(wi, v.surface.ng) > 0.0) == (localZ > 0.0);
}

// Picks a light and prepares its shadow ray; false: nothing to be had.
bool nextEvent(Vertex v, vec3 throughput, out ShadowRay shadow) {
    const LightSample light = sampleLight(frame, unpackReceiver(receivingPoint(v.surface), v.receiver),
                                          v.surface.n, sampleBits2D(v.key, kDimensionLight));
    const vec3 wi = toLocal(v.basis, light.wi);
    if (!isSameSide(v, light.wi, wi.z))
        return false;
    const float bsdfPdf = pdfBsdf(v.bsdf, v.wo, wi) * (kMisSurvival != 0u ? v.survival : 1.0);
    const float weight = light.isDelta ? 1.0 : misWeight(kMis, light.pdf, bsdfPdf);
    const vec3 arriving = evalBsdf(v.bsdf, v.wo, wi) * light.radiance * (weight / light.pdf);
    const vec3 left =
        transmittanceTowards(v.surface, v.media, light.wi, distance(light.end, receivingPoint(v.surface)));
    shadow.contribution = clamped(throughput * arriving * left, v.key.vertex);
    shadow.origin = shadowOrigin(v.surface, light.wi);
    shadow.direction = light.end - shadow.origin;
    shadow.fromSurface = ignoredSurface(v.surface);
    shadow.toSurface = light.surface;
    return light.pdf > 0.0 && shadow.contribution != vec3(0.0);
}

// Draws the next ray; false: absorbed.
bool nextRay(Vertex v, inout Path path, out Ray ray) {
    const BsdfSample next =
        sampleBsdf(v.bsdf, v.wo, sample2D(v.key, kDimensionBsdf), sample1D(v.key, kDimensionLobe));
    const vec3 wi = toWorld(v.basis, next.wi);
    const vec3 origin = nextOrigin(v.surface, v.media, wi);
    ray = Ray(origin, ignoredSurface(v.surface), wi, next.wi.z, v.receiver, kNoInterior);
    path.throughput *= next.weight;
    if (sceneHas(kFeatureSolids)) {
        ray.interior = passes(v.surface, wi) ? v.media.beyond : v.media.here;
        const float started = max(dot(origin - receivingPoint(v.surface), wi), 0.0);
        path.throughput *= transmittanceTowards(v.surface, v.media, wi, started);
    }
    path.bsdfPdf = next.pdf * (kMisSurvival != 0u ? v.survival : 1.0);
    path.etaScale *= next.eta * next.eta;
    return path.throughput != vec3(0.0) && isSameSide(v, wi, next.wi.z);
}

// Kills the path or makes up for those that died; indirect light only: what NEE found stays. survival: the probability.
bool survives(Vertex v, inout Path path, out float survival) {
    survival = 1.0;
    const bool isSmooth = path.bsdfPdf == 0.0;
    if (v.key.vertex < frame.rouletteStart || isSpared(kRoulette, v.key.vertex, isSmooth))
        return true;
    survival = min(v.survival, survivalByThroughput(kRoulette, path.throughput * path.etaScale));
    if (survival >= 1.0)
        return true;
    if (sample1D(v.key, kDimensionRoulette) >= survival)
        return false;
    path.throughput /= survival;
    return true;
}

Vertex makeVertex(Interaction surface, MaterialRecord material, vec3 wo, SampleKey key) {
    Vertex v;
    v.surface = surface;
    v.bsdf = surfaceOf(material, surface.isFront);
    if (isTransmissive(v.bsdf) || (sceneHas(kFeatureSolids) && surface.solid != 0u)) // rays to both sides start at one point
        v.surface.isLifted = false;
    v.basis = shadingBasis(surface, material.anisotropy, material.anisotropyRotation);
    if (sceneHas(kFeatureClearcoat)) // normal maps of the base leave it alone
        v.bsdf.clearcoat.normal = toLocal(v.basis, surface.coatNormal);
    v.wo = toLocal(v.basis, wo);
    v.receiver = sceneHas(kFeatureLightTree) ? packReceiver(surface.n, isTransmissive(v.bsdf)) : 0u;
    v.key = key;
    v.survival = key.vertex < frame.rouletteStart
                     ? 1.0
                     : survivalByAlbedo(kRoulette, frame.rouletteProbability, directionalAlbedo(v.bsdf, v.wo));
    return v;
}
