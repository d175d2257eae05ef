#include "python/pixel_maker.h"

#include "python/device_use.h"
#include "session/developed_film.h"

namespace lavalight::python {

std::vector<uint32_t> PixelMaker::pixelsOf(const FinishedImage& image) {
    const std::lock_guard lock(mutex_);
    beginDeviceUse();
    if (!toneMapper_) {
        device_.emplace(gpu::DeviceConfig());
        toneMapper_.emplace(*device_);
    }
    return lavalight::pixelsOf(image, *device_, *toneMapper_);
}

void PixelMaker::clear() {
    const std::lock_guard lock(mutex_);
    toneMapper_.reset();
    device_.reset();
}

PixelMaker& PixelMaker::ofProcess() {
    static auto* maker = new PixelMaker; // never destroyed: clear() ends what is in it
    return *maker;
}

} // namespace lavalight::python
