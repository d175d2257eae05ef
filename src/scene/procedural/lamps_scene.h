// A procedural scene for benchmarks: as many lights as asked for.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace lavalight {

// A floor with a few boxes on it, and above it `lampCount` (1 to 1,000,000) small triangles that shine
// downwards, of the same power altogether however many they are. Throws Error for other counts.
[[nodiscard]] Scene makeLampsScene(uint32_t lampCount);

} // namespace lavalight
