// Picks a light by descending from child to child, each as likely as what it may bring to the receiver among all of its node.
// Based on: Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018, section 5.
#include "lib/features.glsl"
#include "lib/sampling/light_importance.glsl"
#include "scene/receiver.glsl"
#include "shared/bindings.h"

layout(set = 0, binding = BINDING_LIGHT_TREE) uniform utextureBuffer lightTree; // kLightTreeTexels a node

LightTreeRecord fetchLightTreeNode(uint index) {
    const int first = int(kLightTreeTexels * index);
    const uvec4 a = texelFetch(lightTree, first);
    const uvec4 b = texelFetch(lightTree, first + 1);
    float inverseRange2 = 0.0;
    if (sceneHas(kFeatureLightRange))
        inverseRange2 = uintBitsToFloat(texelFetch(lightTree, first + 2).x);
    return LightTreeRecord(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), b.x, b.y, uintBitsToFloat(b.z), b.w,
                           inverseRange2, float[3](0.0, 0.0, 0.0));
}

// What the children of a node bring to a receiver, each together with those before it.
struct LightTreeSums {
    float upTo[kLightTreeWidth];
};

LightTreeSums sumsOfChildren(uint first, Receiver receiver) {
    LightTreeSums sums;
    float sum = 0.0;
    for (uint i = 0u; i < kLightTreeWidth; ++i) {
        sum += lightImportance(fetchLightTreeNode(first + i), receiver.p, receiver.n, receiver.bothSides);
        sums.upTo[i] = sum;
    }
    return sums;
}

// The child whose part of the sum contains `place`; children that bring nothing have no part.
uint childAt(LightTreeSums sums, float place) {
    uint child = 0u;
    for (uint i = 1u; i < kLightTreeWidth; ++i)
        child = place >= sums.upTo[i - 1u] && sums.upTo[i] > sums.upTo[i - 1u] ? i : child;
    return child;
}

// Where the child's part of the sum begins and ends.
vec2 partOfChild(LightTreeSums sums, uint child) {
    vec2 part = vec2(0.0, sums.upTo[0]);
    for (uint i = 1u; i < kLightTreeWidth; ++i)
        part = child == i ? vec2(sums.upTo[i - 1u], sums.upTo[i]) : part;
    return part;
}

uint lightTreeReference(uint index) {
    return texelFetch(lightTree, int(kLightTreeTexels * index) + 1).w;
}

bool isLightTreeLeaf(uint reference) {
    return (reference & kLightTreeLeafBit) != 0u;
}

struct LightTreePick {
    uint light;
    float pmf;   // 0: no light brings anything
    float place; // what is left of u: uniform in [0, 1) again, or a little beyond by rounding
};

LightTreePick pickFromLightTree(Receiver receiver, float u) {
    uint reference = lightTreeReference(0u);
    LightTreePick pick = LightTreePick(0u, 1.0, u);
    while (!isLightTreeLeaf(reference)) {
        const uint first = reference & kLightTreeIndexMask;
        const LightTreeSums sums = sumsOfChildren(first, receiver);
        const float all = sums.upTo[kLightTreeWidth - 1u];
        const float place = pick.place * all;
        const uint child = childAt(sums, place);
        const vec2 part = partOfChild(sums, child);
        const float width = part.y - part.x;
        pick.pmf *= all > 0.0 ? width / all : 0.0;
        pick.place = (place - part.x) / width;
        reference = pick.pmf > 0.0 ? lightTreeReference(first + child) : kLightTreeLeafBit;
    }
    pick.light = reference & kLightTreeIndexMask;
    return pick;
}

// Probability with which pickFromLightTree picks the light at the end of `path`.
float lightTreePmf(Receiver receiver, uint path) {
    uint reference = lightTreeReference(0u);
    float pmf = 1.0;
    while (!isLightTreeLeaf(reference) && pmf > 0.0) {
        const uint first = reference & kLightTreeIndexMask;
        const LightTreeSums sums = sumsOfChildren(first, receiver);
        const float all = sums.upTo[kLightTreeWidth - 1u];
        const uint child = path & (kLightTreeWidth - 1u);
        const vec2 part = partOfChild(sums, child);
        pmf *= all > 0.0 ? (part.y - part.x) / all : 0.0;
        reference = lightTreeReference(first + child);
        path >>= kLightTreeChildBits;
    }
    return pmf;
}
