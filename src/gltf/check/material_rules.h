// The rules of schema_rules.h for materials, their extensions, textures and images.
#pragma once

#include <vector>

#include "gltf/check/schema_rules.h"

namespace lavalight {

void addMaterialRules(std::vector<ObjectRule>& rules);

} // namespace lavalight
