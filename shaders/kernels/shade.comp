#version 460
// One vertex of each path: what it emits, what lights send it directly, and where the path goes on.
// Based on: Kajiya, "The Rendering Equation", 1986; Laine, Karras, Aila, "Megakernels Considered Harmful", HPG 2013.
#include "lib/mis.glsl"
#include "lib/onb.glsl"
#include "lib/roulette.glsl"
#include "scene/frame.glsl"
#include "scene/interaction.glsl"
#include "scene/light.glsl"
#include "scene/material.glsl"
#include "scene/wave.glsl"

layout(local_size_x = 64) in;
layout(constant_id = CONSTANT_NEE) const uint kNee = 1u;
layout(constant_id = CONSTANT_MIS) const uint kMis = kMisPower;
layout(constant_id = CONSTANT_ROULETTE) const uint kRoulette = kRouletteThroughput;
layout(set = 0, binding = BINDING_HITS, std430) readonly buffer Hits { Hit hits[]; };

// How much of the emission found by this path's BSDF ray counts, next to what NEE found at the previous vertex.
float emissionWeight(Path path, Interaction surface, float t, vec3 wo) {
    const bool wasNeeImpossible = path.bsdfPdf == 0.0 || kNee == 0u || surface.emitter == kNoEmitter;
    if (wasNeeImpossible)
        return 1.0;
    if (kMis == kMisOff)
        return 0.0;
    const float pdfArea = emitterPmf(surface.emitter) * squareToTrianglePdfArea(surface.area);
    return misWeight(kMis, path.bsdfPdf, areaToSolidAngle(pdfArea, t * t, dot(surface.ng, wo)));
}

// f |cos| for world directions, 0 where n and ng disagree about the side of wi.
vec3 evalWorld(Surface bsdf, Basis basis, vec3 ng, vec3 wo, vec3 wi, out float pdf) {
    const vec3 localWo = toLocal(basis, wo);
    const vec3 localWi = toLocal(basis, wi);
    pdf = 0.0;
    if (dot(wi, ng) <= 0.0)
        return vec3(0.0);
    pdf = pdfBsdf(bsdf, localWo, localWi);
    return evalBsdf(bsdf, localWo, localWi);
}

// Picks a point on a light and prepares its shadow ray; false: nothing to be had.
bool nextEvent(Interaction surface, Surface bsdf, Basis basis, vec3 wo, vec3 throughput, SampleKey key,
               out ShadowRay shadow) {
    const LightSample light = sampleLight(surface.p, sampleBits(key, kDimensionLight), frame.emitterCount);
    float bsdfPdf;
    const vec3 f = evalWorld(bsdf, basis, surface.ng, wo, light.wi, bsdfPdf);
    const float weight = misWeight(kMis, light.pdf, bsdfPdf);
    shadow.contribution = throughput * f * light.emission * (weight / light.pdf);
    shadow.origin = offsetOrigin(surface.p, surface.pError, surface.ng, light.wi);
    shadow.direction = offsetOrigin(light.p, light.pError, light.ng, -light.wi) - shadow.origin;
    shadow.fromTriangle = surface.triangle;
    shadow.toTriangle = light.triangle;
    return light.pdf > 0.0 && shadow.contribution != vec3(0.0);
}

// Draws the next direction; false: absorbed, or killed by roulette.
bool nextDirection(Interaction surface, Surface bsdf, Basis basis, vec3 wo, uint slot, uint vertex, inout Path path) {
    const SampleKey key = keyOfSlot(slot, vertex);
    const BsdfSample next = sampleBsdf(bsdf, toLocal(basis, wo), sample3D(key, kDimensionBsdf));
    const vec3 wi = toWorld(basis, next.wi);
    path.throughput *= next.weight;
    path.bsdfPdf = next.pdf;
    if (path.throughput == vec3(0.0) || dot(wi, surface.ng) <= 0.0)
        return false;
    rays[slot] = Ray(offsetOrigin(surface.p, surface.pError, surface.ng, wi), surface.triangle, wi, 0.0);

    const float survival = survivalProbability(kRoulette, vertex, frame.rouletteStart, path.throughput);
    if (survival >= 1.0)
        return true;
    path.throughput /= survival;
    return sample3D(key, kDimensionRoulette).x < survival;
}

void main() {
    const uint bounce = range.bounce;
    if (gl_GlobalInvocationID.x >= counters[bounce].rays)
        return;
    const uint slot = queues[rayQueueStart(bounce, frame.waveSize) + gl_GlobalInvocationID.x];
    const Hit hit = hits[slot];
    Path path = paths[slot];
    bool goesOn = false;
    bool wantsShadowRay = false;
    const uint vertex = bounce + 1u;

    if (hit.t == kInfinity) {
        path.radiance += path.throughput * frame.environment;
    } else {
        const vec3 wo = -rays[slot].direction;
        const Interaction surface = makeInteraction(hit, wo);
        const MaterialRecord material = fetchMaterial(surface.material);

        // ---- Emission ----
        const vec3 emission = emissionOf(material, surface.isFront);
        if (emission != vec3(0.0))
            path.radiance += path.throughput * emission * emissionWeight(path, surface, hit.t, wo);

        if (bounce < frame.maxBounces) {
            const Surface bsdf = surfaceOf(material);
            const Basis basis = makeBasis(surface.n);

            // ---- Next-event estimation ----
            if (kNee != 0u && frame.emitterCount > 0u) {
                ShadowRay shadow;
                wantsShadowRay =
                    nextEvent(surface, bsdf, basis, wo, path.throughput, keyOfSlot(slot, vertex), shadow);
                if (wantsShadowRay)
                    shadowRays[slot] = shadow;
            }

            // ---- BSDF sampling and roulette ----
            goesOn = nextDirection(surface, bsdf, basis, wo, slot, vertex, path);
        } else {
            path.isCut = 1u;
        }
    }
    paths[slot] = path;
    appendShadowRay(wantsShadowRay, slot, bounce, frame.waveSize);
    appendRay(goesOn, slot, bounce + 1u, frame.waveSize);
}
