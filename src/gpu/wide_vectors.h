// Vectors of 512 bits for lavapipe, which takes 256 unless LP_NATIVE_VECTOR_WIDTH says otherwise.
#pragma once

#include <string_view>

#include <vulkan/vulkan_raii.hpp>

namespace lavalight::gpu {

// Whether the processor has AVX-512 as Ice Lake, Zen 4 and later ones do.
[[nodiscard]] bool processorHasWideVectors();

// Whether a device is a lavapipe that takes 256 bits and is faster with 512: one of Mesa 25 and later, on a
// processor that has them. docs/notes/performance.md has the figures. `info`: the driver's, as "Mesa 25.0.7
// (LLVM 19.1.7)"; `name`: the device's.
[[nodiscard]] bool gainsByWideVectors(std::string_view info, std::string_view name, bool processorHasThem);

// Lets instances decide on 512 bits. For programs that own their process: lavapipe reads the variable
// whenever it lists or opens a device or compiles a kernel, so that the width holds for all its users in the
// process, and for the programs that it starts.
void allowWideVectors();

// Whether 512 bits are allowed, the processor has them, and nobody has chosen a width.
[[nodiscard]] bool mayUseWideVectors();

// Whether a device of the instance gains by them. Not where it has a graphics card, since the folder of
// keepKernelsByWidth() would be that of its driver, too.
[[nodiscard]] bool gainsByWideVectors(const vk::raii::Instance& instance);

// Chooses 512 bits for the process. No device of lavapipe may be open.
void useWideVectors();

// Where a width was chosen, by useWideVectors() or by the user, gives it a cache of Mesa's to itself. Mesa 25
// keeps texture code apart from kernels and finds it whatever its width: a kernel that calls code of another
// width crashes, does not end, or draws a wrong picture.
void keepKernelsByWidth();

} // namespace lavalight::gpu
