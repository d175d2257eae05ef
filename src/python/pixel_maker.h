// A device that makes pixels of films that were rendered elsewhere.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "gpu/device.h"
#include "render/tone_mapper.h"
#include "session/outputs.h"

namespace lavalight::python {

// Opens its device when pixels are first asked for.
class PixelMaker {
  public:
    // Throws Error where this process has no device, or was forked from one that had.
    [[nodiscard]] std::vector<uint32_t> pixelsOf(const FinishedImage& image);
    // Ends the device: before the process does, since drivers end with it.
    void clear();

    [[nodiscard]] static PixelMaker& ofProcess();

  private:
    std::mutex mutex_;
    std::optional<gpu::Device> device_;
    std::optional<ToneMapper> toneMapper_;
};

} // namespace lavalight::python
