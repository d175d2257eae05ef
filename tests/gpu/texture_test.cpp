// Textures on the device show what glTF's samplers say: wrap modes, filters, colour spaces, depths, sizes.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "device_scene/gpu_textures.h"
#include "support/pictures.h"
#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Question { // as in the kernel
    glm::vec2 uv;
    uint32_t texture;
    uint32_t unused;
};

// The reference: texels as the file has them, coordinates folded by their definitions, in double precision.
double channel(const Picture& p, uint32_t x, uint32_t y, size_t c, bool decodes) {
    const size_t i = (size_t{y} * p.width + x) * 4 + c;
    const double v = p.is16Bit ? (p.bytes[2 * i] + 256.0 * p.bytes[2 * i + 1]) / 65535.0 : p.bytes[i] / 255.0;
    if (!decodes || c == 3)
        return v;
    return v > 0.04045 ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92;
}

uint32_t fold(double i, uint32_t size, Wrap wrap) {
    const double n = size;
    double folded = std::min(std::max(i, 0.0), n - 1.0);
    if (wrap == Wrap::repeat)
        folded = i - n * std::floor(i / n);
    if (wrap == Wrap::mirror) {
        const double m = i - 2.0 * n * std::floor(i / (2.0 * n));
        folded = m < n ? m : 2.0 * n - 1.0 - m;
    }
    return static_cast<uint32_t>(folded);
}

glm::dvec4 referenceTexel(const Picture& p, const Texture& t, double x, double y) {
    glm::dvec4 v;
    for (size_t c = 0; c < 4; ++c)
        v[static_cast<glm::length_t>(c)] =
            channel(p, fold(x, p.width, t.wrapU), fold(y, p.height, t.wrapV), c, t.isSrgb);
    return v;
}

glm::dvec4 reference(const Picture& p, const Texture& t, const glm::dvec2& uv) {
    const double x = uv.x * p.width;
    const double y = uv.y * p.height;
    if (t.isNearest)
        return referenceTexel(p, t, std::floor(x), std::floor(y));
    glm::dvec4 sum(0.0); // tents around the nine nearest texel centres, of which at most four count
    for (double j = std::floor(y) - 1.0; j <= std::floor(y) + 1.0; ++j)
        for (double i = std::floor(x) - 1.0; i <= std::floor(x) + 1.0; ++i)
            sum += std::max(0.0, 1.0 - std::abs(x - i - 0.5)) * std::max(0.0, 1.0 - std::abs(y - j - 0.5)) *
                   referenceTexel(p, t, i, j);
    return sum;
}

// Every combination of wrap modes, filter and colour space for each picture.
Scene allTextures() {
    Scene scene;
    constexpr std::array<glm::uvec2, 5> kSizes{{{1, 1}, {1, 5}, {7, 1}, {5, 3}, {64, 37}}};
    for (const glm::uvec2& size : kSizes)
        for (const bool is16Bit : {false, true})
            scene.pictures.push_back(
                noisePicture(size.x, size.y, is16Bit, static_cast<uint32_t>(scene.pictures.size())));
    for (uint32_t picture = 0; picture < scene.pictures.size(); ++picture)
        for (const Wrap wrapU : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
            for (const Wrap wrapV : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
                for (const bool isNearest : {false, true})
                    for (const bool isSrgb : {false, true}) {
                        Texture texture = textureOf(picture);
                        texture.wrapU = wrapU;
                        texture.wrapV = wrapV;
                        texture.isNearest = isNearest;
                        texture.isSrgb = isSrgb;
                        scene.materials.emplace_back().textures[0] = texture;
                    }
    return scene;
}

// Rounding may lead a nearest lookup to the neighbour from here: 1e-5 of the texture's width.
bool isNearBorder(double u, uint32_t size) {
    const double x = u * size;
    return std::abs(x - std::round(x)) < 1e-5 * size;
}

class TextureTest : public DeviceTest {
  protected:
    std::vector<glm::vec4> lookUp(const Scene& scene, const std::vector<Question>& questions) {
        const PackedTextures packed = packTextures(scene);
        gpu::Buffer pictures(device(), "pictures", std::span(packed.pictures).size_bytes(),
                             gpu::BufferUse::texels);
        pictures.upload(std::span<const uvec4>(packed.pictures));
        gpu::Buffer records(device(), "textures", std::span(packed.records).size_bytes(),
                            gpu::BufferUse::texels);
        records.upload(std::span<const TextureRecord>(packed.records));
        gpu::ResourceTable resources;
        resources.set("pictures", pictures);
        resources.set("textures", records);
        return KernelRunner(device(), test_kernels::find("texture_test"), resources)
            .map<glm::vec4>(questions);
    }
};

TEST_F(TextureTest, ShowTheTexelsThatTheirSamplersName) {
    const Scene scene = allTextures();
    Random random(1);
    std::vector<Question> questions;
    for (uint32_t texture = 0; texture < scene.materials.size(); ++texture)
        for (int i = 0; i < 300; ++i) {
            const float reach = i % 3 == 0 ? 1.0f : 6.0f;
            questions.push_back({{random.between(-reach, reach), random.between(-reach, reach)}, texture, 0});
        }
    const std::vector<glm::vec4> values = lookUp(scene, questions);
    size_t compared = 0;
    for (size_t i = 0; i < questions.size(); ++i) {
        const Texture& texture = *scene.materials[questions[i].texture].textures[0];
        const Picture& picture = scene.pictures[texture.picture];
        const glm::dvec2 uv(questions[i].uv);
        if (texture.isNearest && (isNearBorder(uv.x, picture.width) || isNearBorder(uv.y, picture.height)))
            continue;
        ++compared;
        const glm::dvec4 expected = reference(picture, texture, uv);
        // Shares of texels are off by up to 2^-21 of 6 times 64 texels, decoding by a few 1e-6.
        ASSERT_LT(glm::length(glm::dvec4(values[i]) - expected), 3e-4)
            << picture.width << " x " << picture.height << (picture.is16Bit ? ", 16 bits" : "") << ", wrap "
            << static_cast<int>(texture.wrapU) << static_cast<int>(texture.wrapV)
            << (texture.isNearest ? ", nearest" : ", bilinear") << (texture.isSrgb ? ", sRGB" : "") << ", at "
            << uv.x << ", " << uv.y;
    }
    EXPECT_GT(compared, questions.size() * 9 / 10);
}

TEST_F(TextureTest, DecodeEverySrgbValueExactly) {
    std::vector<glm::uvec4> texels;
    for (uint32_t i = 0; i < 256; ++i)
        texels.emplace_back(i, 255 - i, 0, i);
    Scene scene;
    scene.pictures = {pictureOf(256, 1, texels)};
    Texture texture = textureOf(0);
    texture.isSrgb = true;
    scene.materials.emplace_back().textures[0] = texture;
    std::vector<Question> questions;
    for (uint32_t i = 0; i < 256; ++i)
        questions.push_back({{(static_cast<float>(i) + 0.5f) / 256.0f, 0.5f}, 0, 0});
    const std::vector<glm::vec4> values = lookUp(scene, questions);
    for (uint32_t i = 0; i < 256; ++i) {
        EXPECT_NEAR(values[i].r, channel(scene.pictures[0], i, 0, 0, true), 3e-6) << i;
        EXPECT_NEAR(values[i].a, i / 255.0, 1e-6) << i;
    }
}

} // namespace
} // namespace lavalight::test
