#include "hosted/bvh16_rays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#ifdef __x86_64__
#include <immintrin.h>
#endif

#include "shared/scene.h"

namespace lavalight {
namespace {

// A triangle's t may be off by 1e-4, on slivers. A box is left out where the ray enters it farther behind the
// nearest triangle than that; the factor is kProposalMargin of shaders/scene/proposed_hit.glsl.
constexpr float kMargin = 1.0f + 2e-4f;

// The planes of a box move apart by this, relative to how far anything of the scene is from the ray's origin
// along an axis: twice kSlabTolerance of shaders/lib/math/ray_box.glsl, which says why.
constexpr float kPlaneTolerance = 2.0f * 16.0f / 16777216.0f;

// Rays that are unlike are traced together in trees of at most this many nodes. In larger ones they are
// faster one by one.
constexpr size_t kMostNodesOfPackets = 1;

// The most children that wait while a tree is traversed.
constexpr uint32_t kMostWaiting = kMaxBvh16Levels * (kBvh16Width - 1) + 1;

constexpr float kSmallestDirection = 1e-18f; // of shaders/lib/math/ray_direction.glsl

// What a ray has found.
struct Search {
    TriangleTaker taker;
    size_t ray;
    bool cullsBackFaces, isAny;
    float end; // of what is still looked for
    Bvh16Hit first{0.0f, kNoTriangle, 0, {}, false};

    void meet(const Bvh16Hit& hit) {
        const bool comesFirst = hit.t < end || (isFound() && hit.t == end && hit.triangle < first.triangle);
        const bool isAsked = (hit.material & kAlphaBit) != 0 || (cullsBackFaces && !hit.front);
        if (!comesFirst || (isAsked && !taker.takes(taker.taker, ray, hit)))
            return;
        first = hit;
        end = hit.t;
    }
    [[nodiscard]] bool isFound() const { return first.triangle != kNoTriangle; }
    [[nodiscard]] bool isOver() const { return isFound() && isAny; }
};

// Classes of directions: the axis along which they are largest, and their signs. Rays of one class meet the
// same planes of boxes first, and turn triangles alike.
constexpr uint32_t kDirectionClasses = 24;

// Without branches, which the processor would guess wrong for rays that are unlike.
uint32_t directionClass(const glm::vec3& direction) {
    const glm::uvec3 bits = glm::floatBitsToUint(direction);
    // Bits of floats that are not negative are ordered as the floats are. Those of smaller ones count as
    // withoutZeros() changes them.
    const glm::uvec3 size = glm::max(bits & 0x7fffffffu, glm::floatBitsToUint(kSmallestDirection));
    const uint32_t isX = static_cast<uint32_t>(size.x >= size.y) & static_cast<uint32_t>(size.x >= size.z);
    const auto isY = static_cast<uint32_t>(size.y >= size.z);
    const uint32_t mainAxis = (1 - isX) * (2 - isY);
    return mainAxis << 3 | bits.x >> 31 << 2 | bits.y >> 31 << 1 | bits.z >> 31;
}

// What rays of a class have in common.
struct Turn {
    size_t nearPlanes[3], farPlanes[3]; // of Bvh16Node::planes, by axis
    size_t axes[3];                     // the main one last
};

constexpr std::array<Turn, kDirectionClasses> kTurns = [] {
    std::array<Turn, kDirectionClasses> turns{};
    for (size_t i = 0; i < kDirectionClasses; ++i)
        for (size_t axis = 0; axis < 3; ++axis) {
            const bool isBackwards = (i >> (2 - axis) & 1) != 0;
            turns[i].nearPlanes[axis] = isBackwards ? axis + 3 : axis;
            turns[i].farPlanes[axis] = isBackwards ? axis : axis + 3;
            turns[i].axes[axis] = ((i >> 3) + 1 + axis) % 3;
        }
    return turns;
}();

// The order in which rays are traced: their own, or by classes of directions.
constexpr size_t kRaysAtATime = 2048;
class RayOrder {
  public:
    // At most kRaysAtATime rays; the first has the number `first`.
    RayOrder(std::span<const Bvh16Ray> rays, size_t first, bool byClass) {
        std::array<uint8_t, kRaysAtATime> classes;
        if (!byClass)
            ends_[0] = static_cast<uint32_t>(rays.size());
        for (size_t i = 0; i < rays.size() && byClass; ++i) {
            classes[i] = static_cast<uint8_t>(directionClass(rays[i].direction));
            ++ends_[classes[i]];
        }
        uint32_t before = 0;
        for (uint32_t& end : ends_)
            before = std::exchange(end, before) + before;
        for (size_t i = 0; i < rays.size(); ++i)
            numbers_[ends_[byClass ? classes[i] : 0]++] = static_cast<uint32_t>(first + i);
    }
    [[nodiscard]] size_t endOfClass(size_t place) const { return *std::ranges::upper_bound(ends_, place); }
    [[nodiscard]] std::span<const uint32_t> numbers(size_t begin, size_t end) const {
        return std::span(numbers_).subspan(begin, end - begin);
    }

  private:
    std::array<uint32_t, kRaysAtATime> numbers_;
    std::array<uint32_t, kDirectionClasses> ends_{}; // of the classes, among the numbers
};

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

} // namespace

void traverse(const Bvh16Query& query) {
#ifdef __x86_64__
    static const bool hasAvx2 = __builtin_cpu_supports("avx2") != 0;
    if (hasAvx2) {
        avx2::find(query);
        return;
    }
#endif
    traverseByFour(query);
}

void traverseByFour(const Bvh16Query& query) {
    baseline::find(query);
}

} // namespace lavalight
