#include "support/pictures.h"

#include "support/random_numbers.h"

namespace lavalight::test {

Picture pictureOf(uint32_t width, uint32_t height, const std::vector<glm::uvec4>& texels) {
    Picture picture;
    picture.name = "test picture";
    picture.width = width;
    picture.height = height;
    for (const glm::uvec4& texel : texels)
        for (glm::length_t c = 0; c < 4; ++c)
            picture.bytes.push_back(static_cast<uint8_t>(texel[c]));
    return picture;
}

Picture noisePicture(uint32_t width, uint32_t height, bool is16Bit, uint32_t seed) {
    Random random(seed);
    Picture picture;
    picture.name = "noise";
    picture.width = width;
    picture.height = height;
    picture.is16Bit = is16Bit;
    picture.bytes.resize(size_t{width} * height * (is16Bit ? 8 : 4));
    for (uint8_t& byte : picture.bytes)
        byte = static_cast<uint8_t>(random.bits() >> 24);
    return picture;
}

Texture textureOf(uint32_t picture) {
    Texture texture;
    texture.picture = picture;
    texture.isNearest = true;
    return texture;
}

void putOnRectangle(Scene& scene, size_t mesh, TextureSlot slot, const Texture& texture) {
    scene.meshes[mesh].uvs = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    scene.materials[scene.meshes[mesh].material].textures[static_cast<size_t>(slot)] = texture;
}

} // namespace lavalight::test
