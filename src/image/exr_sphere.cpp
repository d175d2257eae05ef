// Based on: OpenEXR's "Technical Introduction", "Environment Maps", whose functions say where a direction
// lies.
#include "image/exr_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <ImathBox.h>
#include <ImfEnvmap.h>
#include <ImfHeader.h>
#include <ImfStandardAttributes.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "image/pixel_limit.h"

namespace lavalight {
namespace {

constexpr uint32_t kFaces = 6;

// Windows of damaged files may be as large as integers allow.
struct Extent {
    int64_t width = 0;
    int64_t height = 0;
};

Extent extentOf(const Imath::Box2i& window) {
    return {int64_t{window.max.x} - window.min.x + 1, int64_t{window.max.y} - window.min.y + 1};
}

bool isEmpty(const Extent& extent) {
    return extent.width < 1 || extent.height < 1;
}

Image inDisplayWindow(Image image, const Imath::Box2i& data, const Imath::Box2i& display,
                      uint64_t mostPixels) {
    if (data == display)
        return image;
    const Extent extent = extentOf(display);
    if (isEmpty(extent) || extent.width > kMaxImageSide || extent.height > kMaxImageSide)
        throw Error(fmt::format("its display window has {} x {} pixels; the limit is {} a side", extent.width,
                                extent.height, kMaxImageSide));
    const Imath::Box2i shared({std::max(data.min.x, display.min.x), std::max(data.min.y, display.min.y)},
                              {std::min(data.max.x, display.max.x), std::min(data.max.y, display.max.y)});
    const Extent visible = extentOf(shared);
    if (isEmpty(visible))
        throw Error("all of its pixels lie outside of its display window");
    const auto width = static_cast<uint32_t>(extent.width);
    const auto height = static_cast<uint32_t>(extent.height);
    requirePixelsFit(width, height, mostPixels, sizeof(glm::vec3));
    Image whole(width, height);
    for (int y = shared.min.y; y <= shared.max.y; ++y) {
        const auto rowOf = [&](const Imath::Box2i& window, uint32_t columns) {
            return static_cast<size_t>(y - window.min.y) * columns +
                   static_cast<size_t>(shared.min.x - window.min.x);
        };
        std::copy_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(rowOf(data, image.width)),
                    visible.width, whole.pixels.begin() + static_cast<std::ptrdiff_t>(rowOf(display, width)));
    }
    return whole;
}

// The direction of a point of an equirectangular map, u and v in [0, 1], in OpenEXR's axes: the middle of a
// map faces +Z, its right edge is reached by way of -X.
Imath::V3f directionAt(double u, double v) {
    const double longitude = -2.0 * std::numbers::pi * (u - 0.5);
    const double latitude = std::numbers::pi * (0.5 - v);
    const double ring = std::cos(latitude);
    return {static_cast<float>(std::sin(longitude) * ring), static_cast<float>(std::sin(latitude)),
            static_cast<float>(std::cos(longitude) * ring)};
}

// The faces of a cube map as the file has them, looked up bilinearly. Faces that meet share the pixels of
// their edge, so that none has to ask its neighbour.
class Cube {
  public:
    explicit Cube(const Image& image)
        : image_(image),
          window_({0, 0}, {static_cast<int>(image.width) - 1, static_cast<int>(image.height) - 1}),
          last_(static_cast<int>(image.width) - 1) {}

    [[nodiscard]] glm::vec3 at(const Imath::V3f& direction) const {
        Imf::CubeMapFace face = Imf::CUBEFACE_POS_X;
        Imath::V2f place;
        Imf::CubeMap::faceAndPixelPosition(direction, window_, face, place);
        const int x = std::clamp(static_cast<int>(place.x), 0, std::max(last_ - 1, 0));
        const int y = std::clamp(static_cast<int>(place.y), 0, std::max(last_ - 1, 0));
        const float right = std::clamp(place.x - static_cast<float>(x), 0.0f, 1.0f);
        const float below = std::clamp(place.y - static_cast<float>(y), 0.0f, 1.0f);
        return glm::mix(glm::mix(pixel(face, x, y), pixel(face, x + 1, y), right),
                        glm::mix(pixel(face, x, y + 1), pixel(face, x + 1, y + 1), right), below);
    }

  private:
    [[nodiscard]] const glm::vec3& pixel(Imf::CubeMapFace face, int x, int y) const {
        const Imath::V2f inFace(static_cast<float>(std::min(x, last_)),
                                static_cast<float>(std::min(y, last_)));
        const Imath::V2f place = Imf::CubeMap::pixelPosition(face, window_, inFace);
        return image_.at(static_cast<uint32_t>(std::lround(place.x)),
                         static_cast<uint32_t>(std::lround(place.y)));
    }

    const Image& image_;
    const Imath::Box2i window_;
    const int last_; // column or row of a face
};

// Four pixels around for each of a face's side, and two points a side of each pixel: where a face is seen
// largest, in its corners, its pixels are 0.8 of those points apart.
Image unfoldedCube(const Image& faces, uint64_t mostPixels) {
    if (faces.height != kFaces * faces.width)
        throw Error(
            fmt::format("it says that it is a cube map, and its {} x {} pixels are not six squares one "
                        "below another",
                        faces.width, faces.height));
    constexpr uint32_t kPoints = 2;
    requirePixelsFit(uint64_t{4} * faces.width, uint64_t{2} * faces.width, mostPixels, sizeof(glm::vec3));
    Image map(4 * faces.width, 2 * faces.width);
    const Cube cube(faces);
    forEachInParallel(map.height, [&](size_t y) {
        for (uint32_t x = 0; x < map.width; ++x) {
            glm::vec3 sum(0.0f);
            for (uint32_t i = 0; i < kPoints * kPoints; ++i) {
                const uint32_t row = i / kPoints;
                const double u = (x + (i % kPoints + 0.5) / kPoints) / map.width;
                const double v = (static_cast<double>(y) + (row + 0.5) / kPoints) / map.height;
                sum += cube.at(directionAt(u, v));
            }
            map.pixels[y * map.width + x] = sum / float{kPoints * kPoints};
        }
    });
    return map;
}

} // namespace

Image aroundSphere(Image image, const Imf::Header& header, uint64_t mostPixels) {
    if (!Imf::hasEnvmap(header))
        return inDisplayWindow(std::move(image), header.dataWindow(), header.displayWindow(), mostPixels);
    return Imf::envmap(header) == Imf::ENVMAP_CUBE ? unfoldedCube(image, mostPixels) : image;
}

} // namespace lavalight
