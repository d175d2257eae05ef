// How a path went on from a traced vertex, or why it did not, in words.
#pragma once

#include "shared/traced_path.h"

namespace lavalight {

[[nodiscard]] const char* fateOf(const TracedVertex& vertex);

} // namespace lavalight
