// The material extensions of glTF, each by its exact name.
#pragma once

#include <string_view>

#include "gltf/read/extension_reader.h"

namespace lavalight {

// Brings what the extension says into the reader's material. Names that are not known are left alone.
void readMaterialExtension(std::string_view name, ExtensionReader& reader);

} // namespace lavalight
