// Classes of materials that kernels of their own shade: each leaves out the code that its class does not
// need.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "shared/features.h"

namespace lavalight {

struct MaterialClass {
    std::string_view name;
    SceneFeatures without = 0; // features of the scene that neither the class nor the scene's lights have
};

struct MaterialClasses {
    std::vector<MaterialClass> list;  // those that some material is in; never empty
    std::vector<uint8_t> ofMaterials; // index into the list, for each material of the scene
};

[[nodiscard]] MaterialClasses materialClasses(const Scene& scene);

} // namespace lavalight
