// Fuzzes the readers of environment maps: Radiance HDR and OpenEXR.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "base/error.h"
#include "fuzz/memory_file.h"
#include "image/environment_file.h"

namespace {

bool isGood(const glm::vec3& pixel) {
    const auto isRadiance = [](float value) { return std::isfinite(value) && value >= 0.0f; };
    return isRadiance(pixel.x) && isRadiance(pixel.y) && isRadiance(pixel.z);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const lavalight::test::MemoryFile file(data, size);
    try {
        const lavalight::Image image = lavalight::readEnvironmentFile(file.path()).image;
        if (image.pixels.size() != size_t{image.width} * image.height ||
            !std::all_of(image.pixels.begin(), image.pixels.end(), isGood))
            std::abort();
    } catch (const lavalight::Error&) {
        return 0;
    }
    return 0;
}
