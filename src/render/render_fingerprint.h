// What decides the bits of a render beside its settings, as hashes: scene, view and shaders as compiled.
#pragma once

#include "device_scene/fingerprint.h"
#include "render/renderer.h"

namespace lavalight {

// The scene's fingerprints, and "environment", "view", "shaders". The image's size and what settings put into
// the frame are left out: they have names of their own.
[[nodiscard]] Fingerprints fingerprintsOf(const Renderer& renderer);

} // namespace lavalight
