#include "image/environment_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>

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

bool hasEnvironmentExtension(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    constexpr std::array<std::string_view, 3> kExtensions{".hdr", ".pic", ".exr"};
    return std::any_of(kExtensions.begin(), kExtensions.end(), [&](std::string_view known) {
        return std::equal(extension.begin(), extension.end(), known.begin(), known.end(),
                          [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
    });
}

EnvironmentFile readEnvironmentFile(const std::filesystem::path& path) {
    EnvironmentFile file;
    file.image = isExr(path) ? readExrEnvironment(path, kMostTexels) : readHdr(path, kMostTexels);
    for (glm::vec3& pixel : file.image.pixels) {
        const glm::bvec3 good(isGood(pixel.x), isGood(pixel.y), isGood(pixel.z));
        file.badTexels += glm::all(good) ? 0u : 1u;
        for (glm::length_t c = 0; c < 3; ++c)
            pixel[c] = good[c] ? pixel[c] : 0.0f;
    }
    return file;
}

} // namespace lavalight
