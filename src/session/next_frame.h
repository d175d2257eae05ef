// Where the surfaces of a scene are in the next frame, for the layer of motion.
#pragma once

#include "scene/scene.h"

namespace lavalight {

// `next` is the same scene a moment later, seen by `camera`. Places count from the origin of `scene`. Meshes
// that it lacks, or has with other vertices, do not move; each kind of them gets a line of warning in
// `scene`.
[[nodiscard]] NextFrame nextFrameOf(Scene& scene, const Scene& next, Camera camera);

} // namespace lavalight
