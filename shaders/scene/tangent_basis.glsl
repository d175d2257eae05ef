// Tangents of triangles: the bases that normal maps and anisotropy are given in.
#include "lib/math/octahedral.glsl"
#include "lib/math/onb.glsl"
#include "shared/bindings.h"
#include "shared/surface_id.h"
#include "shared/texture.h"

layout(set = 0, binding = BINDING_TRIANGLE_TANGENTS) uniform utextureBuffer triangleTangents; // one a triangle, plane by plane

TriangleTangents fetchTriangleTangents(uint texel) {
    const uvec4 t = texelFetch(triangleTangents, int(texel));
    return TriangleTangents(t.x, t.y, t.z, t.w);
}

float bitangentSign(uint flags, uint corner) {
    return (flags >> corner & 1u) != 0u ? -1.0 : 1.0;
}

// At barycentrics b, around the normal n that the mesh gives to its front: tangent and bitangent as interpolated, not
// made perpendicular, which is how normal maps are baked. A mesh without tangents gets some basis. first: of the plane of
// tangents.
Basis tangentBasis(SurfaceId surface, uint first, vec3 b, vec3 n) {
    const TriangleTangents t = fetchTriangleTangents(first + attributeIndex(surface));
    const vec3 tangent =
        b.x * decodeOctahedral(t.t0) + b.y * decodeOctahedral(t.t1) + b.z * decodeOctahedral(t.t2);
    const float sign = b.x * bitangentSign(t.flags, 0u) + b.y * bitangentSign(t.flags, 1u) + b.z * bitangentSign(t.flags, 2u);
    const vec3 bitangent = (sign < 0.0 ? -1.0 : 1.0) * cross(n, tangent);
    const bool isUsable = (t.flags & kNoTangents) == 0u && dot(bitangent, bitangent) > 1e-8;
    if (!isUsable)
        return makeBasis(n);
    return Basis(normalize(tangent), normalize(bitangent), n);
}
