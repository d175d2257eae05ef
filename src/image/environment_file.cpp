#include "image/environment_file.h"

#include <array>
#include <cmath>
#include <fstream>

#include "base/file.h"
#include "image/exr.h"
#include "image/hdr.h"
#include "image/pixel_limit.h"

namespace lavalight {
namespace {

bool isExr(const std::filesystem::path& path) {
    requireRegularFile(path);
    std::array<char, 4> magic{};
    std::ifstream(path, std::ios::binary).read(magic.data(), magic.size());
    return magic == std::array<char, 4>{0x76, 0x2f, 0x31, 0x01} || path.extension() == ".exr";
}

bool isGood(float value) {
    return std::isfinite(value) && value >= 0.0f;
}

} // namespace

EnvironmentFile readEnvironmentFile(const std::filesystem::path& path) {
    EnvironmentFile file;
    file.image = isExr(path) ? readExrRadiance(path, kMostTexels) : readHdr(path, kMostTexels);
    for (glm::vec3& pixel : file.image.pixels) {
        const glm::bvec3 good(isGood(pixel.x), isGood(pixel.y), isGood(pixel.z));
        file.badTexels += glm::all(good) ? 0u : 1u;
        for (glm::length_t c = 0; c < 3; ++c)
            pixel[c] = good[c] ? pixel[c] : 0.0f;
    }
    return file;
}

} // namespace lavalight
