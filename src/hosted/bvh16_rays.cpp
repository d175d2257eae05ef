#include "hosted/bvh16_rays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#ifdef __x86_64__
#include <immintrin.h>
#endif

#include "shared/scene.h"

namespace lavalight {
namespace {

// A triangle's t may be off by 1e-4, on slivers. A box is left out where the ray enters it farther behind the
// nearest triangle than that; the factor is kProposalMargin of shaders/scene/proposed_hit.glsl.
float withMargin(float end) {
    return end * (1.0f + 2e-4f);
}

// The planes of a box move apart by this, relative to how far anything of the scene is from the ray's origin
// along an axis: twice kSlabTolerance of shaders/lib/math/ray_box.glsl, which says why.
constexpr float kPlaneTolerance = 2.0f * 16.0f / 16777216.0f;

// A ray for boxes. Its origin is moved towards the near planes, and away from the far ones, by the tolerance.
struct SlabRay {
    float nearOrigin[3], farOrigin[3], inverse[3];
    size_t nearPlanes[3], farPlanes[3]; // of Bvh16Node::planes
};

// A ray for triangles, its main axis last.
struct LeafRay {
    float origin[3], shear[3];
    size_t axes[3];
    int32_t firstIgnored, secondIgnored;
};

// What a ray has found.
struct Search {
    TriangleTaker taker;
    bool cullsBackFaces, isAny;
    float end; // of what is still looked for
    Bvh16Hit first{};
    bool isFound = false;

    void meet(const Bvh16Hit& hit, uint32_t material) {
        const bool comesFirst = hit.t < end || (isFound && hit.t == end && hit.triangle < first.triangle);
        const bool isAsked = (material & kAlphaBit) != 0 || (cullsBackFaces && !hit.front);
        if (!comesFirst || (isAsked && !taker.takes(taker.taker, hit)))
            return;
        first = hit;
        end = hit.t;
        isFound = true;
    }
    [[nodiscard]] bool isOver() const { return isFound && isAny; }
};

SlabRay slabRay(const Bvh16Ray& ray, const Bounds& bounds) {
    SlabRay slab{};
    const glm::vec3 reach =
        glm::max(glm::abs(ray.origin - bounds.lower), glm::abs(bounds.upper - ray.origin));
    const float tolerance = kPlaneTolerance * std::max({reach.x, reach.y, reach.z});
    for (int axis = 0; axis < 3; ++axis) {
        const float direction = ray.direction[axis];
        const bool isBackwards = std::signbit(direction);
        // Far from the world's origin, two units in the last place keep the sum from losing the tolerance.
        const float shift = tolerance + std::abs(ray.origin[axis]) * 0x1p-22f;
        const float away = isBackwards ? -shift : shift;
        slab.inverse[axis] = 1.0f / direction;
        slab.nearOrigin[axis] = ray.origin[axis] + away;
        slab.farOrigin[axis] = ray.origin[axis] - away;
        slab.nearPlanes[axis] = static_cast<size_t>(isBackwards ? axis + 3 : axis);
        slab.farPlanes[axis] = static_cast<size_t>(isBackwards ? axis : axis + 3);
    }
    return slab;
}

LeafRay leafRay(const Bvh16Ray& ray) {
    LeafRay turned{};
    for (int i = 0; i < 3; ++i) {
        const int axis = (ray.mainAxis + 1 + i) % 3;
        turned.axes[i] = static_cast<size_t>(axis);
        turned.origin[i] = ray.origin[axis];
        turned.shear[i] = ray.shear[i];
    }
    turned.firstIgnored = static_cast<int32_t>(ray.firstIgnored);
    turned.secondIgnored = static_cast<int32_t>(ray.secondIgnored);
    return turned;
}

#ifdef __x86_64__

namespace avx2 {
#define LANES 8
#define LAVALIGHT_TARGET __attribute__((target("avx2")))
LAVALIGHT_TARGET inline uint32_t bitsOf(int32_t __attribute__((vector_size(32))) lanes) {
    return static_cast<uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(lanes)));
}
#include "hosted/bvh16_traversal.inl"
#undef LAVALIGHT_TARGET
#undef LANES
} // namespace avx2

#endif

namespace baseline {
#define LANES 4
#define LAVALIGHT_TARGET
inline uint32_t bitsOf(int32_t __attribute__((vector_size(16))) lanes) {
#ifdef __x86_64__
    return static_cast<uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(lanes)));
#else
    uint32_t bits = 0;
    for (int lane = 0; lane < LANES; ++lane)
        bits |= static_cast<uint32_t>(lanes[lane]) & 1u << lane;
    return bits;
#endif
}
#include "hosted/bvh16_traversal.inl"
#undef LAVALIGHT_TARGET
#undef LANES
} // namespace baseline

using Traversal = void (*)(const Bvh16&, const SlabRay&, const LeafRay&, Search&);

const Traversal kFastest =
#ifdef __x86_64__
    __builtin_cpu_supports("avx2") != 0 ? avx2::traverseTree :
#endif
                                        baseline::traverseTree;

std::optional<Bvh16Hit> traverseBy(Traversal traversal, const Bvh16& bvh, const Bvh16Ray& ray,
                                   TriangleTaker taker, bool isAny) {
    const glm::vec3 sum = ray.origin + ray.direction;
    if (!std::isfinite(sum.x + sum.y + sum.z))
        return std::nullopt;
    Search search{taker, ray.cullsBackFaces, isAny, ray.end};
    traversal(bvh, slabRay(ray, bvh.bounds), leafRay(ray), search);
    return search.isFound ? std::optional(search.first) : std::nullopt;
}

} // namespace

std::optional<Bvh16Hit> traverse(const Bvh16& bvh, const Bvh16Ray& ray, TriangleTaker taker, bool isAny) {
    return traverseBy(kFastest, bvh, ray, taker, isAny);
}

std::optional<Bvh16Hit> traverseByFour(const Bvh16& bvh, const Bvh16Ray& ray, TriangleTaker taker,
                                       bool isAny) {
    return traverseBy(baseline::traverseTree, bvh, ray, taker, isAny);
}

} // namespace lavalight
