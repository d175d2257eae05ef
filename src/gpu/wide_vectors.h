// Vectors of 512 bits for lavapipe, which takes 256 unless LP_NATIVE_VECTOR_WIDTH says otherwise.
#pragma once

#include <string_view>

#include <vulkan/vulkan_raii.hpp>

namespace lavalight::gpu {

// Whether a device is a lavapipe that runs kernels faster with 512 bits than with its 256: one of Mesa 25 and
// later, on a processor of that width (docs/notes/performance.md has the figures). `info`: the driver's, as
// "Mesa 25.0.7 (LLVM 19.1.7)"; `name`: the device's.
[[nodiscard]] bool gainsByWideVectors(std::string_view info, std::string_view name, bool processorHasThem);

// Whether a device of the instance gains by them, where nobody has decided the width for this process.
[[nodiscard]] bool gainsByWideVectors(const vk::raii::Instance& instance);

// Decides on 512 bits for the rest of the process. lavapipe reads the variable each time that devices are
// listed or opened, and has one width for all of them: a second width would spoil the kernels of the first.
void useWideVectors();

// Where a width was decided, by useWideVectors() or by the user, gives it a folder of Mesa's cache to itself.
// Mesa looks up compiled code without its width. A kernel that calls texture code of another width hangs or
// draws a wrong picture.
void keepKernelsByWidth();

} // namespace lavalight::gpu
