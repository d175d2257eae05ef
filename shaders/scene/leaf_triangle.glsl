// Triangles of the BVH's leaves.
#include "shared/bindings.h"
#include "shared/bvh.h"

layout(set = 0, binding = BINDING_LEAF_TRIANGLES) uniform utextureBuffer leafTriangles; // kLeafTriangleTexels each

LeafTriangle loadLeafTriangle(uint index) {
    const int texel = int(index * kLeafTriangleTexels);
    const uvec4 a = texelFetch(leafTriangles, texel);
    const uvec4 b = texelFetch(leafTriangles, texel + 1);
    const uvec4 c = texelFetch(leafTriangles, texel + 2);
    return LeafTriangle(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), c.w);
}
