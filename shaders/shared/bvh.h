// The acceleration structure as it lies in memory: a 4-wide tree whose child boxes are quantised to 8 bits.
//
// A node is 64 bytes, read as four RGBA32UI texels; p(i) = one byte for each of the four children, child 0 lowest:
//
//          x               y               z               w
//   0 | origin.x        origin.y        origin.z        exponents (byte per axis, biased by 127 as in a float)
//   1 | child 0         child 1         child 2         child 3
//   2 | lower x, p(0)   lower y, p(1)   lower z, p(2)   upper x, p(3)
//   3 | upper y, p(4)   upper z, p(5)   spare           spare
//
// A plane of a child's box lies at origin[axis] + byte * 2^exponent[axis], exactly and never inside the child's bounds.
// A child is a node's index, or a leaf:   1 | count (3 bits, 0 to 4) | first leaf triangle (28 bits)
// An empty slot is a leaf of no triangles in an inside-out box, so that one let through by the slab test's tolerance
// costs time and nothing else.
#ifndef LAVALIGHT_SHARED_BVH_H
#define LAVALIGHT_SHARED_BVH_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

SHARED_CONST uint kNodeTexels = 4u;
SHARED_CONST uint kLeafTriangleTexels = 3u;
SHARED_CONST uint kMaxTexels = 134217728u; // Vulkan devices' usual maxTexelBufferElements, lavapipe's too

SHARED_CONST uint kLeafBit = 0x80000000u;
SHARED_CONST uint kEmptyLeaf = kLeafBit;
SHARED_CONST uint kLeafCountShift = 28u;
SHARED_CONST uint kLeafCountMask = 7u;
SHARED_CONST uint kLeafFirstMask = 0x0fffffffu;
SHARED_CONST uint kMaxLeafTriangles = 4u;

// Levels of nodes: the builder makes no deeper tree.
SHARED_CONST uint kMaxBvhLevels = 40u;

// Coordinates reach this far from zero, so that squares of distances and slab distances stay finite floats: 2^63.
SHARED_CONST float kMaxCoordinate = 9.223372e18f;

struct BvhNode {
    vec3 origin;
    uint exponents;
    uvec4 children;
    uint planes[6];
    uint spare[2];
};

// A triangle of a leaf: 48 bytes, three texels. Front: counter-clockwise.
struct LeafTriangle {
    vec3 v0;
    uint triangle; // in the scene's numbering: meshes in order, triangles in order
    vec3 v1;
    uint emitter; // or kNoEmitter
    vec3 v2;
    uint material; // index and flags: shared/scene.h
};

SHARED_CONST uint kNoEmitter = 0xffffffffu;
SHARED_CONST uint kNeverCulledBit = 0x80000000u; // its back face is seen by camera rays too (double sided)

LAVALIGHT_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(lavalight::BvhNode) == 16 * lavalight::kNodeTexels);
static_assert(sizeof(lavalight::LeafTriangle) == 16 * lavalight::kLeafTriangleTexels);
#endif

#endif
