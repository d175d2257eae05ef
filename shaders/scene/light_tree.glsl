// Picks a light by descending into one of two children at a time, each as likely as what it may bring to the receiver.
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

// Two neighbours in the tree, and the probability of the first.
struct LightTreePair {
    uint references[2];
    float first; // negative: neither brings anything
};

LightTreePair fetchLightTreePair(uint index, Receiver receiver) {
    const LightTreeRecord a = fetchLightTreeNode(index);
    const LightTreeRecord b = fetchLightTreeNode(index + 1u);
    const float first = lightImportance(a, receiver.p, receiver.n, receiver.bothSides);
    const float both = first + lightImportance(b, receiver.p, receiver.n, receiver.bothSides);
    return LightTreePair(uint[2](a.reference, b.reference), both > 0.0 ? first / both : -1.0);
}

uint lightTreeRoot() {
    return texelFetch(lightTree, 1).w;
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
    uint reference = lightTreeRoot();
    LightTreePick pick = LightTreePick(0u, 1.0, u);
    while (!isLightTreeLeaf(reference)) {
        const LightTreePair pair = fetchLightTreePair(reference & kLightTreeIndexMask, receiver);
        const bool isFirst = pick.place < pair.first;
        const float probability = isFirst ? pair.first : 1.0 - pair.first;
        pick.pmf *= pair.first < 0.0 ? 0.0 : probability;
        pick.place = (isFirst ? pick.place : pick.place - pair.first) / probability;
        reference = pick.pmf > 0.0 ? pair.references[isFirst ? 0 : 1] : kLightTreeLeafBit;
    }
    pick.light = reference & kLightTreeIndexMask;
    return pick;
}

// Probability with which pickFromLightTree picks the light at the end of `path`.
float lightTreePmf(Receiver receiver, uint path) {
    uint reference = lightTreeRoot();
    float pmf = 1.0;
    while (!isLightTreeLeaf(reference) && pmf > 0.0) {
        const LightTreePair pair = fetchLightTreePair(reference & kLightTreeIndexMask, receiver);
        const bool isFirst = (path & 1u) == 0u;
        pmf *= pair.first < 0.0 ? 0.0 : isFirst ? pair.first : 1.0 - pair.first;
        reference = pair.references[isFirst ? 0 : 1];
        path >>= 1u;
    }
    return pmf;
}
