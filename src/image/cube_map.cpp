#include "image/cube_map.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "base/parallel.h"

namespace lavalight {
namespace {

// Which face a direction meets, and where: s and t from 0 to 1, t from the first row.
struct FacePoint {
    size_t face = 0;
    double s = 0.0;
    double t = 0.0;
};

FacePoint facePointOf(const glm::dvec3& r) {
    const glm::dvec3 length = glm::abs(r);
    FacePoint point;
    glm::dvec3 across; // s, t and the major axis, before division
    if (length.x >= length.y && length.x >= length.z) {
        point.face = r.x >= 0.0 ? 0 : 1;
        across = {r.x >= 0.0 ? -r.z : r.z, -r.y, length.x};
    } else if (length.y >= length.z) {
        point.face = r.y >= 0.0 ? 2 : 3;
        across = {r.x, r.y >= 0.0 ? r.z : -r.z, length.y};
    } else {
        point.face = r.z >= 0.0 ? 4 : 5;
        across = {r.z >= 0.0 ? r.x : -r.x, -r.y, length.z};
    }
    point.s = 0.5 * (across.x / across.z + 1.0);
    point.t = 0.5 * (across.y / across.z + 1.0);
    return point;
}

glm::dvec3 directionOf(double column, double row, uint32_t width, uint32_t height) {
    const double polar = glm::pi<double>() * row / height;
    const double azimuth = 2.0 * glm::pi<double>() * (column / width - 0.5);
    return {std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth)};
}

} // namespace

glm::vec3 lookUp(const CubeMap& faces, const glm::dvec3& direction) {
    const FacePoint point = facePointOf(direction);
    const Image& face = faces[point.face];
    const auto last = static_cast<double>(face.width - 1);
    const double x = std::clamp(point.s * face.width - 0.5, 0.0, last);
    const double y = std::clamp(point.t * face.height - 0.5, 0.0, last);
    const auto x0 = static_cast<uint32_t>(x);
    const auto y0 = static_cast<uint32_t>(y);
    const uint32_t x1 = std::min(x0 + 1, face.width - 1);
    const uint32_t y1 = std::min(y0 + 1, face.height - 1);
    const auto fx = static_cast<float>(x - x0);
    const auto fy = static_cast<float>(y - y0);
    return glm::mix(glm::mix(face.at(x0, y0), face.at(x1, y0), fx),
                    glm::mix(face.at(x0, y1), face.at(x1, y1), fx), fy);
}

Image unrollCubeMap(const CubeMap& faces, const glm::dmat3& toCube) {
    constexpr uint32_t kSamples = 2; // across a pixel of the picture
    const uint32_t width = std::min(4 * faces.front().width, kMaxImageSide);
    Image picture(width, std::max(width / 2, 1u));
    forEachInParallel(picture.height, [&](size_t row) {
        for (uint32_t column = 0; column < width; ++column) {
            glm::vec3 sum(0.0f);
            for (uint32_t i = 0; i < kSamples * kSamples; ++i) {
                const double x = column + (i % kSamples + 0.5) / kSamples;
                const double y = static_cast<double>(row) + (i / kSamples + 0.5) / kSamples;
                sum += lookUp(faces, toCube * directionOf(x, y, width, picture.height));
            }
            picture.pixels[row * width + column] = sum / static_cast<float>(kSamples * kSamples);
        }
    });
    return picture;
}

} // namespace lavalight
