// Writes what is looked at.
#pragma once

#include <string>

#include "gpu/device.h"
#include "render/tone_mapper.h"
#include "session/outputs.h"
#include "view/live_side.h"

namespace lavalight {

// Writes the image so far, of which there must be one: EXR as `lavalight render` does, header and all, and
// PNG as the window shows it. Returns a line that says what was written. Throws Error.
[[nodiscard]] std::string saveImage(const LiveSide& side, ToneMapper& tone, const gpu::Device& device,
                                    const Outputs& files);

} // namespace lavalight
