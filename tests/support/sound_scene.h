// What every scene that an import returns must fulfil, whatever was in the file.
#pragma once

#include <string>

#include "scene/scene.h"

namespace lavalight::test {

// The first thing that is wrong with the scene; empty: it is sound.
[[nodiscard]] std::string unsoundPart(const Scene& scene);

} // namespace lavalight::test
