// Kernels compiled from sources with a change: to break an estimator on purpose, or to take out a shortcut.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gpu/shader_build.h"

namespace lavalight::test {

struct Patch {
    std::string file; // below shaders/
    std::string from; // found exactly once in it
    std::string to;
};

// Throws std::runtime_error where a patch does not apply.
[[nodiscard]] gpu::KernelCode patchedKernel(std::string_view kernel, const Patch& patch);
[[nodiscard]] gpu::KernelCode patchedKernel(std::string_view kernel, const std::vector<Patch>& patches);

} // namespace lavalight::test
