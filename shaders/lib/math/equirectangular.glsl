// Directions as points of an equirectangular map, and back.
//
//        u = 0      0.25     0.5     0.75      1
//   v = 0 +----------- +Y everywhere -----------+
//         |-X       -Z       +X       +Z      -X|
//   v = 1 +----------- -Y everywhere -----------+
#include "lib/math/constants.glsl"

// u in [0, 1], v in [0, 1]. The angle's tangent serves near the poles too, where an arc cosine is off by up to 3e-4.
vec2 directionToEquirectangular(vec3 d) {
    const float across = length(d.xz);
    const float phi = across > 0.0 ? atan(d.z, d.x) : 0.0;
    return vec2(0.5 + 0.5 * kInvPi * phi, kInvPi * atan(across, d.y));
}

vec3 equirectangularToDirection(vec2 uv) {
    const float phi = 2.0 * kPi * (uv.x - 0.5);
    const float theta = kPi * uv.y;
    return vec3(cos(phi) * sin(theta), cos(theta), sin(phi) * sin(theta));
}

// Direction uniform per solid angle between the parallels v.x and v.y: `place` from 0 to 1 by sin^2(theta / 2), which keeps
// its digits at the pole.
vec3 unitToEquirectangularRow(float u, float place, vec2 v) {
    const vec2 h = sin(0.5 * kPi * v);
    const float s = mix(h.x * h.x, h.y * h.y, place);
    const float across = 2.0 * sqrt(s * max(0.0, 1.0 - s));
    const float phi = 2.0 * kPi * (u - 0.5);
    return vec3(cos(phi) * across, 1.0 - 2.0 * s, sin(phi) * across);
}

// The place of the parallel v between the parallels `bounds`.
float equirectangularRowToUnit(float v, vec2 bounds) {
    const float h = sin(0.5 * kPi * v);
    const vec2 ends = sin(0.5 * kPi * bounds);
    return clamp((h - ends.x) * (h + ends.x) / ((ends.y - ends.x) * (ends.y + ends.x)), 0.0, 1.0);
}
