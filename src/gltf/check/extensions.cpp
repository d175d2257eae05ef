#include "gltf/check/extensions.h"

#include "image/basis_universal.h"

namespace lavalight {

bool isExtensionRead(std::string_view name) {
    return extensionNamed(name) != nullptr && (name != "KHR_texture_basisu" || hasBasisUniversal());
}

} // namespace lavalight
