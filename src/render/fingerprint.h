// What decides the bits of an image beside its settings, as hashes of what the device is given, and of
// kernels as they were compiled: two renders are of one scene, one view and the same shaders where these are
// equal, whatever their files are called.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/scene_data.h"
#include "shared/frame.h"

namespace lavalight {

class Renderer;

// Name of a part and its hash.
using Fingerprints = std::vector<std::pair<std::string, std::string>>;

// "geometry" (with the BVH), "materials", "textures", "lights".
[[nodiscard]] Fingerprints fingerprintsOf(const SceneData& scene);
// Those, and "environment", "view", "shaders". The image's size and what settings put into the frame are left
// out: they have names of their own.
[[nodiscard]] Fingerprints fingerprintsOf(const Renderer& renderer);

} // namespace lavalight
