// The faces of the largest level are radiance: what smooth metal shows. Smaller levels are blurred copies for
// rasterisers, and the irradiance coefficients follow from the same light.
#include "gltf/read/image_light.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include "base/os/memory.h"
#include "image/cube_map.h"
#include "image/picture.h"
#include "image/srgb.h"

namespace lavalight {
namespace {

constexpr size_t kFaces = 6;
constexpr const char* kName = "EXT_lights_image_based";
constexpr double kBrightest = 1e15; // as for other lights: sums over a map stay finite

// RGBD: sRGB colours divided by alpha. Pictures without alpha are plain colours, since theirs is 1.
glm::vec3 radianceOf(const Picture& picture, size_t texel, uint64_t& badTexels) {
    std::array<float, 4> value{};
    for (size_t i = 0; i < 4; ++i) {
        const size_t at = texel * 4 + i;
        value[i] =
            picture.is16Bit
                ? static_cast<float>(picture.bytes[2 * at] | picture.bytes[2 * at + 1] << 8u) / 65535.0f
                : static_cast<float>(picture.bytes[at]) / 255.0f;
    }
    if (value[3] == 0.0f) {
        ++badTexels;
        return glm::vec3(0.0f);
    }
    return glm::vec3(decodeSrgb(value[0]), decodeSrgb(value[1]), decodeSrgb(value[2])) / value[3];
}

Image readFace(const GltfDocument& document, size_t index, uint64_t& badTexels) {
    if (index >= document.images.size())
        throw Error(fmt::format("the file has {} images, and a face is another one", document.images.size()));
    const GltfImage& image = document.images[index];
    if (!image.problem.empty())
        throw Error(fmt::format("{}: {}", image.name, image.problem));
    const PictureSize size = measurePicture(image.bytes);
    if (size.width != size.height || size.width > kMaxImageSide / 4)
        throw Error(fmt::format("{} has {} x {} texels; faces are squares of at most {}", image.name,
                                size.width, size.height, kMaxImageSide / 4));
    if (const std::string shortage = memoryShortage(16 * size.bytes()); !shortage.empty())
        throw Error(fmt::format("{} {}", image.name, shortage));
    const Picture picture = decodePicture(image.bytes);
    Image face(picture.width, picture.height);
    for (size_t texel = 0; texel < face.pixels.size(); ++texel)
        face.pixels[texel] = radianceOf(picture, texel, badTexels);
    return face;
}

CubeMap readFaces(const GltfDocument& document, JsonView faces, uint64_t& badTexels) {
    if (faces.size() != kFaces)
        throw Error(fmt::format("a cube map has six faces, not {}", faces.size()));
    CubeMap cube;
    for (size_t i = 0; i < kFaces; ++i) {
        cube[i] = readFace(document, faces[i].asCount(document.images.size()), badTexels);
        if (cube[i].width != cube[0].width)
            throw Error("its faces are of different sizes");
    }
    return cube;
}

// Spherical harmonics up to l = 2, of red, green and blue.
using Harmonics = std::array<glm::dvec3, 9>;

// The radiance whose irradiance has these coefficients (Ramamoorthi and Hanrahan 2001, "An Efficient
// Representation for Irradiance Environment Maps").
Harmonics toRadiance(JsonView irradiance) {
    constexpr double kPi = glm::pi<double>();
    constexpr std::array<double, 9> kConvolution = {kPi,     2 * kPi / 3, 2 * kPi / 3, 2 * kPi / 3, kPi / 4,
                                                    kPi / 4, kPi / 4,     kPi / 4,     kPi / 4};
    Harmonics radiance;
    for (size_t i = 0; i < radiance.size(); ++i) {
        const JsonView color = irradiance[i];
        const glm::dvec3 value(color[0].asNumber(0.0), color[1].asNumber(0.0), color[2].asNumber(0.0));
        radiance[i] = glm::clamp(value, -kBrightest, kBrightest) / kConvolution[i];
    }
    return radiance;
}

// The sum of the harmonics in a direction, at least 0.
glm::vec3 evaluate(const Harmonics& coefficients, const glm::dvec3& d) {
    const std::array<double, 9> basis = {0.282095,
                                         0.488603 * d.y,
                                         0.488603 * d.z,
                                         0.488603 * d.x,
                                         1.092548 * d.x * d.y,
                                         1.092548 * d.y * d.z,
                                         0.315392 * (3 * d.z * d.z - 1),
                                         1.092548 * d.x * d.z,
                                         0.546274 * (d.x * d.x - d.y * d.y)};
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < basis.size(); ++i)
        sum += coefficients[i] * basis[i];
    return glm::vec3(glm::clamp(sum, glm::dvec3(0.0), glm::dvec3(kBrightest)));
}

// A cube map of the harmonics, small since they are smooth.
CubeMap facesOfHarmonics(const Harmonics& coefficients) {
    constexpr uint32_t kSize = 32;
    const std::array<glm::dmat3, kFaces> axes = {{{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},
                                                  {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
                                                  {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                                  {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                                  {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                                  {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};
    CubeMap cube;
    for (size_t i = 0; i < kFaces; ++i) {
        cube[i] = Image(kSize, kSize);
        for (uint32_t y = 0; y < kSize; ++y)
            for (uint32_t x = 0; x < kSize; ++x) {
                const glm::dvec3 place(2.0 * (x + 0.5) / kSize - 1.0, 2.0 * (y + 0.5) / kSize - 1.0, 1.0);
                cube[i].pixels[size_t{y} * kSize + x] =
                    evaluate(coefficients, glm::normalize(axes[i] * place));
            }
    }
    return cube;
}

// The turn from directions of the scene to those of the cube.
glm::dmat3 toCubeOf(JsonView light) {
    const auto q = light.vector<4>("rotation", glm::dvec4(0.0, 0.0, 0.0, 1.0));
    const double length = glm::length(q);
    if (!(length > 0.0) || !std::isfinite(length))
        return glm::dmat3(1.0);
    return glm::transpose(glm::mat3_cast(glm::dquat(q.w, q.x, q.y, q.z) / length));
}

} // namespace

std::optional<EnvironmentMap> readImageLight(const GltfDocument& document, GltfNotes& notes) {
    const JsonView json(document.json);
    const std::optional<size_t> index =
        document.list("scenes")[document.scene]["extensions"][kName].index("light");
    if (!index)
        return std::nullopt;
    const JsonView light = json["extensions"][kName]["lights"][*index];
    const std::string name = describe("image-based light", *index, light.text("name"));
    EnvironmentMap map;
    map.source = name;
    CubeMap cube;
    try {
        cube = readFaces(document, light["specularImages"][size_t{0}], map.badTexels);
    } catch (const Error& error) {
        notes.add(
            fmt::format("{} is lit by its irradiance coefficients alone: {}", name, printable(error.what())));
        cube = facesOfHarmonics(toRadiance(light["irradianceCoefficients"]));
        map.badTexels = 0;
    }
    if (map.badTexels > 0)
        notes.add(
            fmt::format("{} has {} texels whose alpha is 0, which were taken as black", name, map.badTexels));
    map.image = unrollCubeMap(cube, toCubeOf(light));
    const double intensity = light.number("intensity", 1.0);
    if (!(intensity >= 0.0 && intensity <= kBrightest))
        notes.add(fmt::format("{} has an intensity of {:g}, which is taken as one of 0 to {:g}", name,
                              intensity, kBrightest));
    const auto scale = static_cast<float>(std::clamp(intensity, 0.0, kBrightest));
    for (glm::vec3& pixel : map.image.pixels)
        pixel = glm::min(pixel * scale, glm::vec3(static_cast<float>(kBrightest)));
    return map;
}

std::vector<size_t> facesOfLights(JsonView json) {
    std::vector<size_t> faces;
    for (const JsonView light : json["extensions"][kName]["lights"].elements())
        for (const JsonView face : light["specularImages"][size_t{0}].elements())
            faces.push_back(face.asCount(static_cast<uint64_t>(-1)));
    return faces;
}

} // namespace lavalight
