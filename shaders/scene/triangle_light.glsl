// Emissive triangles as lights, sampled by area, or by solid angle where they are seen large.
#include "lib/math/ray_offset.glsl"
#include "lib/sampling/spherical_triangle.glsl"
#include "lib/sampling/warp.glsl"
#include "scene/alpha.glsl"
#include "scene/coated_emission.glsl"
#include "scene/triangle_record.glsl"
#include "scene/light_sample.glsl"
#include "scene/material.glsl"
#include "scene/texture.glsl"
#include "shared/scene.h"

// By area, the variance grows with how much distance and cosine change over the triangle: seen under less than this, in
// steradians, they change little, and Arvo's arithmetic loses digits.
const float kSmallestSolidAngle = 0.05;

// Density per area turned into density per solid angle: distance^2 / |cos| as seen from the receiver.
float areaToSolidAngle(float pdfArea, float distance2, float cosLight) {
    return pdfArea * distance2 / max(abs(cosLight), 1e-20);
}

// As seen from `from`; 0 where it is to be sampled by area.
float largeSolidAngle(TriangleRecord t, vec3 from) {
    const float solidAngle = solidAngleOf(normalize(t.v0 - from), normalize(t.v1 - from), normalize(t.v2 - from));
    return solidAngle > kSmallestSolidAngle ? solidAngle : 0.0;
}

// Density per solid angle of finding a point of the triangle from `from`, distance and cosine as given.
float triangleLightPdf(TriangleRecord t, vec3 from, float area, float distance2, float cosLight) {
    const float solidAngle = largeSolidAngle(t, from);
    if (solidAngle > 0.0)
        return 1.0 / solidAngle;
    return areaToSolidAngle(squareToTrianglePdfArea(area), distance2, cosLight);
}

// Barycentrics of the point of the triangle's plane in direction wi.
vec3 barycentricsOf(TriangleRecord t, vec3 from, vec3 wi) {
    const vec3 e1 = t.v1 - t.v0;
    const vec3 e2 = t.v2 - t.v0;
    const vec3 p = cross(wi, e2);
    const float determinant = dot(e1, p);
    const vec3 s = from - t.v0;
    const float b1 = dot(s, p) / determinant;
    const float b2 = dot(wi, cross(s, e1)) / determinant;
    const vec3 b = clamp(vec3(1.0 - b1 - b2, b1, b2), 0.0, 1.0);
    return b / (b.x + b.y + b.z);
}

// Radiance that leaves barycentrics b of the triangle t, number `record`, along wo, as much of it as alpha and a coat let
// be.
vec3 emissionAt(TriangleRecord t, uint record, vec3 b, vec3 wo, bool isFront) {
    const MaterialRecord material = fetchMaterial(t.material & kMaterialMask);
    vec3 emission = emissionOf(material, isFront);
    if (sceneHas(kFeatureCoatedLights))
        emission *= coatTransmittance(material, wo, makeInteraction(Hit(0.0, record, b.yz), wo));
    if (sceneHas(kFeatureTextures) && hasTexture(material.textureSlots, kSlotEmission))
        emission *=
            textureAt(textureIndex(material.firstTexture, material.textureSlots, kSlotEmission), t.surface, b).rgb;
    if (sceneHas(kFeatureAlpha) && (t.material & kAlphaBit) != 0u)
        emission *= coverageAt(t, b);
    return emission;
}

LightSample sampleTriangleLight(vec3 from, vec2 u, uint record) {
    const TriangleRecord t = loadTriangle(record);
    vec3 b;
    if (largeSolidAngle(t, from) > 0.0) {
        const SphericalTriangle seen =
            makeSphericalTriangle(normalize(t.v0 - from), normalize(t.v1 - from), normalize(t.v2 - from));
        b = barycentricsOf(t, from, squareToSphericalTriangle(u, seen));
    } else {
        const vec2 warped = squareToTriangle(u);
        b = vec3(1.0 - warped.x - warped.y, warped);
    }
    const vec3 normal = cross(t.v1 - t.v0, t.v2 - t.v0);
    const float twiceArea = length(normal);
    const vec3 ng = normal / twiceArea;
    const vec3 p = b.x * t.v0 + b.y * t.v1 + b.z * t.v2;
    const vec3 d = p - from;
    const float distance2 = max(dot(d, d), 1e-37);
    LightSample light;
    light.wi = d * inversesqrt(distance2);
    const float cosLight = -dot(light.wi, ng);
    light.end = offsetOrigin(p, hitPointError(b, t.v0, t.v1, t.v2), ng, -light.wi);
    light.radiance = emissionAt(t, record, b, -light.wi, cosLight > 0.0);
    light.pdf = triangleLightPdf(t, from, 0.5 * twiceArea, distance2, cosLight);
    light.isDelta = false;
    light.surface = t.surface;
    if (!(abs(cosLight) > 0.0)) // seen from its own plane, where the drawn point may be undefined
        light = kNoLightSample;
    return light;
}
