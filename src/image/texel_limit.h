// How many texels a buffer on the device holds.
#pragma once

#include <cstdint>

namespace lavalight {

// Elements of a texel buffer on the devices that we know (Vulkan's maxTexelBufferElements). kMaxTexels of
// shaders/shared/bvh.h is this number for both languages.
constexpr uint64_t kMostBufferTexels = 134'217'728;

} // namespace lavalight
