// Writes what is looked at.
#pragma once

#include <string>

#include "gpu/device.h"
#include "render/tone_mapper.h"
#include "session/outputs.h"
#include "view/live_side.h"

namespace lavalight {

// How a saved image is made into pictures.
struct SavedPicture {
    bool isDenoised = false;
    float exposure = 0.0f; // stops
};

// Writes the image so far, of which there must be one, as `lavalight render` does with the options of its
// request: EXR with layers, header and all, and PNG of the colour or the denoised one. Returns a line that
// says what was written. Throws Error.
[[nodiscard]] std::string saveImage(const LiveSide& side, const SavedPicture& picture, ToneMapper& tone,
                                    const gpu::Device& device, const Outputs& files);

} // namespace lavalight
