// The film as pixels for a display, computed on the device.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/device.h"
#include "gpu/kernel.h"
#include "kernels/kernel_source.h"
#include "render/film.h"
#include "render/tone_settings.h"
#include "shared/tone.h"

namespace lavalight {

// Runs shaders/kernels/tonemap.comp over a film.
class ToneMapper {
  public:
    // Compiles the kernel for every curve. The device must outlive the mapper. Throws Error as `source` does.
    explicit ToneMapper(gpu::Device& device, const KernelSource& source = embeddedKernel);

    // sRGB pixels of one of the film's planes, the colour as a rule; rows from the top, each R, G, B
    // and alpha from its lowest byte up. Alpha is straight, and 255 where the film has no plane of coverage,
    // or the tone a backdrop. Pixels without samples are black, and so is what is negative. Device memory is
    // kept from call to call, as much as the largest band so far took. Not while a submission writes the
    // film.
    [[nodiscard]] std::vector<uint32_t> map(const Film& film, const ToneSettings& tone,
                                            size_t plane = kColorPlane);

    // Pixels of an image in the same way, with its coverage, of which x counts, or null, and the part of its
    // coverage that is shadow, or null. Values are finite.
    [[nodiscard]] std::vector<uint32_t> map(const Image& image, const Image* coverage,
                                            const ToneSettings& tone, const Image* shadow = nullptr);

    // Whether the kernel's code is another by `source`. Throws Error as `source` does.
    [[nodiscard]] bool isChanged(const KernelSource& source) const;

    // Device time of all calls so far; empty on a queue without timestamps.
    [[nodiscard]] const gpu::KernelTimes& times() const { return commands_.times(); }

  private:
    // `range`: all but the pixels of a dispatch.
    void mapBand(const gpu::Buffer& sums, const gpu::Kernel& kernel, ToneRange range,
                 std::span<uint32_t> pixels);

    gpu::Device* device_;
    std::map<ToneCurve, gpu::Kernel> kernels_;
    gpu::Buffer display_; // pixels of one band
    gpu::Commands commands_;
};

} // namespace lavalight
