// Which accelerator kernels trace rays with, as part of their names.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace lavalight {

// Folders of shaders/scene/, and part of a film's identity: accelerators may round otherwise.
inline constexpr std::string_view kBvh8 = "bvh8";
inline constexpr std::string_view kRayQuery = "ray_query";
inline constexpr std::array kKernelAccelerators{kBvh8, kRayQuery};

// The include that stands for the file in an accelerator's folder.
inline constexpr std::string_view kIncludedAccelerator = "scene/accelerator.glsl";

// The file below shaders/ that #include "`path`" names in a kernel of an accelerator.
[[nodiscard]] inline std::string includedFile(const std::string& path, std::string_view accelerator = kBvh8) {
    return path == kIncludedAccelerator ? fmt::format("scene/{}/accelerator.glsl", accelerator) : path;
}

// A kernel's path below shaders/kernels/ without extension, and the accelerator that it traces with, if it
// traces.
struct KernelName {
    std::string_view file;
    std::string_view accelerator;
};

// "path" with bvh8, "path@ray_query" with another.
[[nodiscard]] inline std::string textOf(const KernelName& name) {
    return name.accelerator == kBvh8 ? std::string(name.file)
                                     : fmt::format("{}@{}", name.file, name.accelerator);
}

[[nodiscard]] inline KernelName parseKernelName(std::string_view text) {
    const size_t at = text.find('@');
    return at == std::string_view::npos ? KernelName{text, kBvh8}
                                        : KernelName{text.substr(0, at), text.substr(at + 1)};
}

} // namespace lavalight
