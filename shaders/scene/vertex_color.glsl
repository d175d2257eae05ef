// Colours given at the corners of triangles.
#include "shared/bindings.h"
#include "shared/surface_id.h"
#include "shared/texture.h"

layout(set = 0, binding = BINDING_TRIANGLE_COLORS) uniform utextureBuffer triangleColors; // kColorTexels a triangle

vec4 unpackColor(uvec2 words) {
    return vec4(unpackUnorm2x16(words.x), unpackUnorm2x16(words.y));
}

TriangleColors fetchTriangleColors(uint triangle) {
    const uvec4 a = texelFetch(triangleColors, int(triangle * kColorTexels));
    const uvec4 b = texelFetch(triangleColors, int(triangle * kColorTexels + 1u));
    return TriangleColors(a.xy, a.zw, b.xy, b.zw);
}

// Linear RGBA at barycentrics b.
vec4 vertexColor(SurfaceId surface, vec3 b) {
    const TriangleColors c = fetchTriangleColors(attributeIndex(surface));
    return b.x * unpackColor(c.c0) + b.y * unpackColor(c.c1) + b.z * unpackColor(c.c2);
}
