// One vertex of a path: what it emits, what lights send it directly, and where the path goes on.
// Based on: Kajiya, "The Rendering Equation", 1986.
#include "scene/path_vertex.glsl"
#include "scene/record_layers.glsl"
#include "scene/shadow_catcher.glsl"

// What there is to trace after a vertex.
struct NextRays {
    bool goesOn;
    bool isCut;     // --max-bounces ended the path
    uint crowdedSolid; // a solid that the path is in, where these are more than its list holds for the first time; else 0
    float survival; // probability that roulette left the path; 1: nothing was drawn
    Ray ray;
    bool wantsShadowRay;
    ShadowRay shadow;
};

NextRays nothingNext() {
    NextRays next;
    next.goesOn = false;
    next.isCut = false;
    next.crowdedSolid = 0u;
    next.survival = 1.0;
    next.wantsShadowRay = false;
    return next;
}

// What a ray that meets nothing finds, after `bounce` vertices.
vec3 escape(Ray ray, uint bounce, Path path) {
    if (sceneHas(kFeatureBackground) && frame.hasBackground != 0u && bounce == 0u)
        return path.throughput * frame.background;
    const vec3 found =
        path.throughput * environmentRadiance(frame, ray.direction) * foundLightWeight(path.bsdfPdf, missLightPdf(ray));
    return clamped(found, bounce);
}

// The boundaries of solids that a ray passed block shadow rays: what it finds counts in full.
float pdfOfFinding(Ray ray, float bsdfPdf) {
    return sceneHas(kFeatureSolids) && (ray.interior.notes & kInteriorPassed) != 0u ? 0.0 : bsdfPdf;
}

// The vertex where `ray` met a surface, after `bounce` others: the path collects what is emitted there, and is scattered.
NextRays scatterAt(Hit hit, Ray ray, uint slot, uint bounce, inout Path path) {
    NextRays next = nothingNext();
    Interaction surface = makeInteraction(hit, -ray.direction);
    MaterialRecord material = fetchMaterial(surface.material);
    if (sceneHas(kFeatureSolids) || sceneHas(kFeatureAttenuation))
        path.throughput *= attenuationOf(hit, ray, surface, material);
    const SampleKey key = keyOfSlot(slot, bounce + 1u);
    const float throughCoat = coatTransmittance(material, -ray.direction, surface);
    material = texturedMaterial(material, -ray.direction, key, surface);

    recordPlace(slot, bounce, surface, hit.t);

    // ---- Emission ----
    if (sceneHas(kFeatureUnlit) && (material.flags & kMaterialUnlit) != 0u) {
        const vec3 shown = clamped(path.throughput * material.baseColor, bounce);
        path.radiance += shown;
        recordEmission(slot, bounce, shown);
        return next;
    }
    if (sceneHas(kFeatureEmission)) {
        const vec3 emission = throughCoat * emissionOf(material, surface.isFront);
        if (emission != vec3(0.0)) {
            const vec3 found = clamped(
                path.throughput * emission * foundLightWeight(path.bsdfPdf, hitLightPdf(surface, hit, ray)), bounce);
            path.radiance += found;
            recordEmission(slot, bounce, found);
        }
    }
    recordDirect(slot, bounce, path.radiance);
    next.isCut = bounce >= frame.maxBounces;
    const bool showsAlbedo = recordsLayers() && bounce == 0u;
    if (next.isCut && !showsAlbedo)
        return next;
    MediaSides media;
    if (sceneHas(kFeatureSolids))
        media = mediaSides(ray.interior, surface.solid, surface.isFront);
    if (sceneHas(kFeatureSolids) || sceneHas(kFeatureDispersion))
        chooseIndex(surface, media, key, path, material);
    Vertex vertex = makeVertex(surface, material, -ray.direction, key);
    if (sceneHas(kFeatureSolids))
        vertex.media = media;
    recordAlbedo(slot, bounce, vertex);
    if (next.isCut)
        return next;

    // ---- Next-event estimation ----
    if (kNee != 0u && sceneHas(kFeatureLights) && hasNonDelta(vertex.bsdf))
        next.wantsShadowRay = nextEvent(vertex, path.throughput, next.shadow);

    // ---- BSDF sampling and roulette ----
    next.goesOn = nextRay(vertex, path, next.ray) && survives(vertex, path, next.survival);
    if (sceneHas(kFeatureSolids))
        next.crowdedSolid = newlyCrowdedSolid(next.ray.interior);
    return next;
}

// What becomes of a path whose ray has been traced.
NextRays scatter(Hit hit, Ray ray, uint slot, uint bounce, inout Path path) {
    path.bsdfPdf = pdfOfFinding(ray, path.bsdfPdf);
    if (hit.t == kInfinity) {
        const vec3 found = escape(ray, bounce, path);
        path.radiance += found;
        recordEmission(slot, bounce, found);
        if (bounce == 0u)
            path.etaScale = kUncovered;
        NextRays next = nothingNext();
        if (meetsGround(ray, bounce))
            next.wantsShadowRay = catchLight(ray, slot, path, next.shadow);
        return next;
    }
    return scatterAt(hit, ray, slot, bounce, path);
}
