// Properties of material extensions.
#include "gltf/read/extension_reader.h"

namespace lavalight {

float ExtensionReader::number(const char* member, double otherwise, double lower, double upper) {
    return factors_.clamped(extension_.number(member, otherwise), lower, upper, member);
}

glm::vec3 ExtensionReader::color(const char* member, const glm::vec3& otherwise, double largest) {
    if (!has(member))
        return otherwise;
    return factors_.clamped(extension_.vector<3>(member, glm::dvec3(otherwise)), largest, member);
}

float ExtensionReader::alphaOf(const char* member) {
    return factors_.clamped(extension_.vector<4>(member, glm::dvec4(1.0)).w, 0.0, 1.0, member);
}

void ExtensionReader::texture(const char* member, TextureSlot slot, bool isSrgb) {
    material_.textures[static_cast<size_t>(slot)] = makeTexture(textures_, extension_[member], isSrgb);
}

float ExtensionReader::normalScale(const char* member) const {
    return static_cast<float>(extension_[member].number("scale", 1.0));
}

} // namespace lavalight
