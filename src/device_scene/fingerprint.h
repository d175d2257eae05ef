// What of a scene decides the bits of an image, as hashes of what the device is given: two renders are of
// one scene where these are equal, whatever their files are called.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "device_scene/scene_data.h"

namespace lavalight {

// Name of a part and its hash.
using Fingerprints = std::vector<std::pair<std::string, std::string>>;

// The parts "geometry" (with the BVH), "materials", "textures", "lights", "environment map".
[[nodiscard]] Fingerprints fingerprintsOf(const SceneData& scene);
} // namespace lavalight
