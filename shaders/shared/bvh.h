// The accelerator "bvh8" as it lies in memory: an 8-wide tree whose child boxes are quantised to 8 bits. A leaf triangle is a
// record of shared/triangle.h, in the order of the leaves.
//
// A node is 80 bytes, read as five RGBA32UI texels; a word has one byte for each of four children, the first lowest:
//
//          x               y               z               w
//   0 | origin.x        origin.y        origin.z        exponents (byte per axis, biased by 127 as in a float)
//   1 | first node      first triangle  slots 0 to 3    slots 4 to 7
//   2 | lower x, 0-3    lower x, 4-7    lower y, 0-3    lower y, 4-7
//   3 | lower z, 0-3    lower z, 4-7    upper x, 0-3    upper x, 4-7
//   4 | upper y, 0-3    upper y, 4-7    upper z, 0-3    upper z, 4-7
//
// A plane of a child's box lies at origin[axis] + byte * 2^exponent[axis], exactly and never inside the child's bounds.
// A slot holds a leaf, or a node:   count (3 bits, 0 to 4; 7: a node) | offset from the first leaf triangle or node (5 bits)
// Traversal refers to a node by its index, to a leaf by:   1 | count (3 bits) | first leaf triangle (28 bits)
// An empty slot is a leaf of no triangles in an inside-out box, so that one let through by the slab test's tolerance
// costs time and nothing else.
#ifndef LAVALIGHT_SHARED_BVH_H
#define LAVALIGHT_SHARED_BVH_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

SHARED_CONST uint kNodeTexels = 5u;
SHARED_CONST uint kBvhWidth = 8u;
SHARED_CONST uint kMaxTexels = 134217728u; // Vulkan devices' usual maxTexelBufferElements, lavapipe's too

// Traversal keeps a node's index and a bit for each of its children in one word.
SHARED_CONST uint kMaxNodes = 16777216u;

SHARED_CONST uint kLeafBit = 0x80000000u;
SHARED_CONST uint kEmptyLeaf = kLeafBit;
SHARED_CONST uint kLeafCountShift = 28u;
SHARED_CONST uint kLeafCountMask = 7u;
SHARED_CONST uint kLeafFirstMask = 0x0fffffffu;
SHARED_CONST uint kMaxLeafTriangles = 4u;

SHARED_CONST uint kSlotCountShift = 5u;
SHARED_CONST uint kSlotCountMask = 7u;
SHARED_CONST uint kSlotOffsetMask = 31u;
SHARED_CONST uint kSlotIsNode = 7u; // its count

// Levels of nodes: the builder makes no deeper tree.
SHARED_CONST uint kMaxBvhLevels = 40u;

// Coordinates reach this far from zero, so that squares of distances and slab distances stay finite floats: 2^63.
SHARED_CONST float kMaxCoordinate = 9.223372e18f;

struct BvhChildren {
    uint firstNode;
    uint firstTriangle;
    uvec2 slots;
};

struct BvhNode {
    vec3 origin;
    uint exponents;
    BvhChildren children;
    uvec2 lower[3]; // planes, by axis
    uvec2 upper[3];
};

LAVALIGHT_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(lavalight::BvhNode) == 16 * lavalight::kNodeTexels);
#endif

#endif
