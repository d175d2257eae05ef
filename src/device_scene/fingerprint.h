// What of a scene decides the bits of an image, as hashes of what the device is given: two renders are of
// one scene where these are equal, whatever their files are called and whoever built the tree over it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "device_scene/scene_data.h"

namespace lavalight {

// Name of a part and its hash, or a name.
using Fingerprints = std::vector<std::pair<std::string, std::string>>;

// The parts "geometry", "materials", "textures", "lights", "environment map", and the name of the
// "accelerator".
[[nodiscard]] Fingerprints fingerprintsOf(const SceneData& scene);
} // namespace lavalight
