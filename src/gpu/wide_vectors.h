// Vectors of 512 bits for lavapipe, which takes 256 unless LP_NATIVE_VECTOR_WIDTH says otherwise.
#pragma once

#include <string_view>

#include <vulkan/vulkan_raii.hpp>

#include "base/os/environment.h"

namespace lavalight::gpu {

// Whether a device is a lavapipe that runs kernels faster with 512 bits than with its 256: from Mesa 25 on,
// on processors that have them. Kernels then take 0.74 to 1.0 of the time, with the same bits. Mesa 22.3 took
// 1.2 of it. `info`: the driver's, "Mesa 25.0.7 (LLVM 19.1.7)"; `name`: the device's.
[[nodiscard]] bool gainsByWideVectors(std::string_view info, std::string_view name, bool processorHasThem);

// Whether any device of the instance is one, and the user has not decided the width.
[[nodiscard]] bool gainsByWideVectors(const vk::raii::Instance& instance);

// Has drivers that start meanwhile use 512 bits, with a cache of kernels of their own: Mesa's knows kernels
// without the width that they were compiled for, and a kernel of another width runs at that one's speed.
void askForWideVectors(VariablesForNow& variables);

} // namespace lavalight::gpu
