// Properties of material extensions.
#include "gltf/read/extension_reader.h"

namespace lavalight {

float ExtensionReader::number(const char* member, double otherwise, double lower, double upper) {
    const double value = has(member) ? extension_.Get(member).GetNumberAsDouble() : otherwise;
    return factors_.clamped(value, lower, upper, member);
}

glm::vec3 ExtensionReader::color(const char* member, const glm::vec3& otherwise, double largest) {
    if (!has(member))
        return otherwise;
    std::vector<double> values;
    for (int i = 0; i < 3; ++i)
        values.push_back(extension_.Get(member).Get(i).GetNumberAsDouble());
    return factors_.clamped(values, largest, member);
}

float ExtensionReader::alphaOf(const char* member) {
    const double alpha = has(member) ? extension_.Get(member).Get(3).GetNumberAsDouble() : 1.0;
    return factors_.clamped(alpha, 0.0, 1.0, member);
}

void ExtensionReader::texture(const char* member, TextureSlot slot, bool isSrgb) {
    material_.textures[static_cast<size_t>(slot)] =
        makeTexture(textures_, GltfTextureValue(extension_, member).info, isSrgb);
}

float ExtensionReader::normalScale(const char* member) const {
    if (!has(member) || !extension_.Get(member).Has("scale"))
        return 1.0f;
    return static_cast<float>(extension_.Get(member).Get("scale").GetNumberAsDouble());
}

} // namespace lavalight
