// Which accelerator the kernels are compiled with.
#pragma once

#include <string>
#include <string_view>

namespace lavalight {

// A folder of shaders/scene/, and part of a film's identity: accelerators may round otherwise.
inline constexpr std::string_view kAcceleratorName = "bvh8";

// The file below shaders/ that #include "`path`" names: "scene/accelerator.glsl" is the one in the
// accelerator's folder, every other path is a file itself.
[[nodiscard]] inline std::string includedFile(const std::string& path) {
    if (path != "scene/accelerator.glsl")
        return path;
    return "scene/" + std::string(kAcceleratorName) + "/accelerator.glsl";
}

} // namespace lavalight
