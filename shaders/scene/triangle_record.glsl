// The triangles, in the order of the accelerator, and what surface a record shows.
#include "shared/bindings.h"
#include "shared/triangle.h"

layout(set = 0, binding = BINDING_TRIANGLES) uniform utextureBuffer triangles; // kTriangleTexels each
layout(set = 0, binding = BINDING_TRIANGLE_NORMALS) uniform utextureBuffer triangleNormals;

TriangleRecord loadTriangle(uint record) {
    const int texel = int(record * kTriangleTexels);
    const uvec4 a = texelFetch(triangles, texel);
    const uvec4 b = texelFetch(triangles, texel + 1);
    const uvec4 c = texelFetch(triangles, texel + 2);
    return TriangleRecord(uintBitsToFloat(a.xyz), SurfaceId(a.w), uintBitsToFloat(b.xyz), b.w,
                          uintBitsToFloat(c.xyz), c.w);
}

// The solid whose boundary a surface is, or 0.
uint solidOf(SurfaceId surface) {
    return texelFetch(triangleNormals, int(attributeIndex(surface))).w;
}
