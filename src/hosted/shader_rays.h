// The rays of paths as shaders/scene/path_rays.glsl traces them, compiled for the host. A tree of the host's
// own or Embree finds triangles in the place of the kernels' accelerator.
#pragma once

#include <span>

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtc/packing.hpp>
#include <glm/gtx/vec_swizzle.hpp>

#include "hosted/host_rays.h"
#include "shared/scene.h"
#include "shared/texture.h"
#include "shared/trace.h"

namespace lavalight::glsl {

using namespace glm;

struct TexelBuffer {
    const uvec4* texels = nullptr;
};

inline uvec4 texelFetch(TexelBuffer buffer, int index) {
    return buffer.texels[index];
}

// The shaders' functions, constants and buffers as members. GLSL is written to other rules than those that
// C++ compilers warn about.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wparentheses"
#pragma GCC diagnostic ignored "-Wshadow"
#ifndef __clang__ // clang does not have this one
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
struct ShaderRays {
    SceneFeatures features = 0;
    [[nodiscard]] bool has(SceneFeatures feature) const { return (features & feature) != 0; }

    const Bvh16* bvh16 = nullptr; // null: Embree has the scene
    RTCScene embree = nullptr;

#include "shader_rays_members.h"

    // intersectClosest() and intersectAny().
    bool closestInOwnTree(vec3 origin, vec3 direction, float tMax, const RayFilter& ignored, Hit& hit);
    bool anyInOwnTree(vec3 origin, vec3 direction, float tMax, const RayFilter& ignored);
    bool closestByEmbree(vec3 origin, vec3 direction, float tMax, const RayFilter& ignored, Hit& hit);
    bool anyByEmbree(vec3 origin, vec3 direction, float tMax, const RayFilter& ignored);

    // trace() and isOccluded() of rays in a scene without solids.
    void traceInOwnTree(uint32_t bounce, Likeness likeness, std::span<const uint32_t> slots,
                        std::span<const Ray> rays, std::span<HostHit> hits);
    void findOccludedInOwnTree(uint32_t bounce, std::span<const uint32_t> slots,
                               std::span<const ShadowRay> rays, std::span<uint8_t> occluded);
    static constexpr size_t kMostByEmbree = 8;
    void traceByEmbree(uint32_t bounce, std::span<const uint32_t> slots, std::span<const Ray> rays,
                       std::span<Hit> hits);
};
#pragma GCC diagnostic pop

} // namespace lavalight::glsl
