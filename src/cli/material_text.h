// What a material is made of, in a few words, for `lavalight info`.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace lavalight {

// Names of the material's lobes: "metal", "diffuse", "specular", "glass", "thin glass", "clearcoat", ...
[[nodiscard]] std::vector<std::string> lobeNames(const Material& material);

// What the material has textures for: "baseColor", "normal", ...
[[nodiscard]] std::vector<std::string> textureNames(const Material& material);

[[nodiscard]] const char* alphaModeName(AlphaMode mode);

} // namespace lavalight
