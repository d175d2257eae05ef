// Which surfaces rays may pass through by alpha.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace lavalight {

// Whether each mesh may have a point where a ray is not stopped. Exact for factors and vertex colours; of a
// texture, the least alpha of the whole picture counts.
[[nodiscard]] std::vector<bool> transparentMeshes(const Scene& scene);

} // namespace lavalight
