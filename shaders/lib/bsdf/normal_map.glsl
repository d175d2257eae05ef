// Shading normals from normal maps.
// Based on: glTF 2.0, section 3.9.3; for the bending: Keller et al., "The Iray Light Transport Simulation and Rendering
// System", 2017, appendix A.3.
#include "lib/math/onb.glsl"

// A texel's vector in world space, by the basis that the texel is given in, of unit length. scale: factor of its x and y.
vec3 mappedNormal(Basis basis, vec3 texel, float scale) {
    const vec3 v = (2.0 * texel - 1.0) * vec3(scale, scale, 1.0);
    const vec3 n = toWorld(basis, v);
    const float length2 = dot(n, n);
    return length2 > 1e-12 ? n * inversesqrt(length2) : basis.normal;
}

// The mirror direction of a bent normal rises this far above the surface, as a sine: what follows rounds.
const float kLeastRise = 1e-3;

// n turned just so far towards wo that a mirror would send light from wo to the outside: else a mirror that is seen
// from the side would be black, and what faces away from wo also where it is rough. ng on the side of wo.
vec3 bentNormal(vec3 n, vec3 ng, vec3 wo) {
    if (dot(n, ng) <= 0.0)
        return ng;
    const vec3 mirrored = 2.0 * dot(n, wo) * n - wo;
    const float rise = dot(mirrored, ng);
    if (rise >= kLeastRise)
        return n;
    return normalize(wo + normalize(mirrored + (kLeastRise - rise) * ng));
}
