// Arrays of records as texel buffers.
#pragma once

#include <span>
#include <vector>

#include "gpu/buffer.h"

namespace lavalight {

// `name` is for messages. Throws Error where a limit of the device or its memory is exceeded.
template <typename T>
[[nodiscard]] gpu::Buffer uploadTexels(gpu::Device& device, const char* name, const std::vector<T>& data,
                                       gpu::BufferUse use = gpu::BufferUse::texels) {
    static_assert(sizeof(T) % 16 == 0);
    gpu::Buffer buffer(device, name, data.size() * sizeof(T), use);
    buffer.upload(std::span<const T>(data));
    return buffer;
}

} // namespace lavalight
