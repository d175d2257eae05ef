// What the lights of a cluster may bring to a point: an estimate without visibility and BSDF, and 0 only if they bring
// nothing.
// Based on: Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018, section 5;
// without angles as in Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., 2023, section 12.6.3.
#include "lib/features.glsl"
#include "lib/math/octahedral.glsl"
#include "lib/sampling/range_window.glsl"
#include "shared/scene.h"

// cos(max(0, a - b)) of angles in [0, pi].
float cosOfDifference(float cosA, float cosB) {
    const float sines = sqrt(max(0.0, 1.0 - cosA * cosA) * max(0.0, 1.0 - cosB * cosB));
    return cosA > cosB ? 1.0 : cosA * cosB + sines;
}

const float kLargestImportance = 1e30; // the sum of a node's children stays finite

// `n`: the receiver's normal; `bothSides`: light from behind counts too. Proportional to W/m^2.
float lightImportance(LightTreeRecord node, vec3 p, vec3 n, bool bothSides) {
    const vec3 d = node.center - p;
    const float distance2 = dot(d, d);
    const float radius2 = node.radius * node.radius;
    const vec3 wi = d * inversesqrt(max(distance2, 1e-37));
    // Half the angle under which the sphere is seen; from inside, it is all around.
    const float cosSeen = distance2 <= radius2 ? -1.0 : sqrt(1.0 - radius2 / distance2);

    // ---- Emission: the least angle to a normal that any direction towards the receiver may have ----
    const vec2 cosines = unpackSnorm2x16(node.cosines);
    const float cosAxis = -dot(decodeOctahedral(node.axis), wi);
    const bool isTwoSided = (node.reference & kLightTreeTwoSidedBit) != 0u;
    const float cosSpread = cosOfDifference(isTwoSided ? abs(cosAxis) : cosAxis, cosines.x);
    const float cosEmission = cosOfDifference(cosSpread, cosSeen);

    // ---- Reception ----
    const float cosReceiver = dot(n, wi);
    const float cosReception = cosOfDifference(bothSides ? abs(cosReceiver) : cosReceiver, cosSeen);

    const float falloff = cosEmission >= cosines.y ? max(cosEmission, 0.0) : 0.0;
    float received = node.intensity * falloff * max(cosReception, 0.0) / max(max(distance2, radius2), 1e-37);
    if (sceneHas(kFeatureLightRange)) { // as if all lights were at the nearest point of the sphere, and reached furthest
        const float nearest = max(sqrt(distance2) - node.radius, 0.0);
        received *= rangeWindow(nearest * nearest, node.inverseRange2);
    }
    return min(received, kLargestImportance);
}
