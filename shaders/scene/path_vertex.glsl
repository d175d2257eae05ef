// One vertex of a path: what it emits, what lights send it directly, and where the path goes on.
// Based on: Kajiya, "The Rendering Equation", 1986.
#include "lib/sampling/mis.glsl"
#include "lib/math/onb.glsl"
#include "lib/sampling/roulette.glsl"
#include "lib/solids.glsl"
#include "scene/dispersion.glsl"
#include "scene/frame.glsl"
#include "scene/interaction.glsl"
#include "scene/light.glsl"
#include "scene/material.glsl"
#include "scene/ray_start.glsl"
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

bool isTransmissiveSolid(MaterialRecord m) {
    return (m.flags & kMaterialSolid) != 0u && (m.transmission > 0.0 || m.diffuseTransmission > 0.0);
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
    shadow.contribution = clamped(throughput * arriving, v.key.vertex);
    shadow.origin = rayOrigin(v.surface, light.wi);
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
    ray = Ray(rayOrigin(v.surface, wi), ignoredSurface(v.surface), wi, next.wi.z, v.receiver, kNoInterior);
    path.throughput *= next.weight;
    path.bsdfPdf = next.pdf * (kMisSurvival != 0u ? v.survival : 1.0);
    path.etaScale *= next.eta * next.eta;
    return path.throughput != vec3(0.0) && isSameSide(v, wi, next.wi.z);
}

// Kills the path or makes up for those that died; indirect light only: what NEE found stays. survival: the probability.
bool survives(Vertex v, inout Path path, out float survival) {
    survival = 1.0;
    if (v.key.vertex < frame.rouletteStart)
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
    if (isTransmissive(v.bsdf)) // rays to both sides start at one point
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

// What there is to trace after a vertex.
struct NextRays {
    bool goesOn;
    bool isCut;     // --max-bounces ended the path
    uint overlap;   // packOverlap() of two solids that the path was within at once, it turns out; else 0
    float survival; // probability that roulette left the path; 1: nothing was drawn
    Ray ray;
    bool wantsShadowRay;
    ShadowRay shadow;
};

NextRays nothingNext() {
    NextRays next;
    next.goesOn = false;
    next.isCut = false;
    next.overlap = 0u;
    next.survival = 1.0;
    next.wantsShadowRay = false;
    return next;
}

// Tells the next ray which solids the path has entered, after a vertex `distance` from the one before.
void noteSolids(Ray ray, Interaction surface, float distance, inout NextRays next) {
    if (!sceneHas(kFeatureSolids))
        return;
    const vec3 e = surface.pError;
    const float rounding = 32.0 * max(e.x, max(e.y, e.z)); // covers vertices that were transformed, too
    const bool passes = !surface.isLifted && dot(next.ray.direction, surface.ng) < 0.0;
    next.ray.interior = passes ? passSolid(ray.interior, surface.solid, surface.isFront, distance > rounding)
                               : turnAmongSolids(ray.interior);
    if (solidsState(next.ray.interior) == kSolidsOverlap && solidsState(ray.interior) != kSolidsOverlap)
        next.overlap = packOverlap(next.ray.interior);
}

// The vertex where `ray` met the scene, after `bounce` others: the path collects what is emitted there, and is scattered.
NextRays scatter(Hit hit, Ray ray, uint slot, uint bounce, inout Path path) {
    NextRays next = nothingNext();
    if (hit.t == kInfinity) {
        const vec3 found = path.throughput * environmentRadiance(frame, ray.direction) *
                           foundLightWeight(path.bsdfPdf, missLightPdf(ray));
        path.radiance += clamped(found, bounce);
        return next;
    }
    Interaction surface = makeInteraction(hit, -ray.direction);
    MaterialRecord material = fetchMaterial(surface.material);
    if (sceneHas(kFeatureAttenuation) && !surface.isFront && isTransmissiveSolid(material))
        path.throughput *= exp(-material.attenuation * hit.t); // Beer-Lambert: the ray came through the inside
    const SampleKey key = keyOfSlot(slot, bounce + 1u);
    material = texturedMaterial(material, -ray.direction, key, surface);

    // ---- Emission ----
    if (sceneHas(kFeatureUnlit) && (material.flags & kMaterialUnlit) != 0u) {
        path.radiance += clamped(path.throughput * material.baseColor, bounce);
        return next;
    }
    const vec3 emission = emissionOf(material, surface.isFront);
    if (emission != vec3(0.0))
        path.radiance += clamped(
            path.throughput * emission * foundLightWeight(path.bsdfPdf, hitLightPdf(surface, hit, ray)), bounce);
    next.isCut = bounce >= frame.maxBounces;
    if (next.isCut)
        return next;
    if (sceneHas(kFeatureDispersion) && isDispersive(material))
        chooseChannel(sample1D(key, kDimensionChannel), path, material);
    const Vertex vertex = makeVertex(surface, material, -ray.direction, key);

    // ---- Next-event estimation ----
    if (kNee != 0u && sceneHas(kFeatureLights) && hasNonDelta(vertex.bsdf))
        next.wantsShadowRay = nextEvent(vertex, path.throughput, next.shadow);

    // ---- BSDF sampling and roulette ----
    next.goesOn = nextRay(vertex, path, next.ray) && survives(vertex, path, next.survival);
    noteSolids(ray, vertex.surface, hit.t, next);
    return next;
}
