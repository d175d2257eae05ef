#include "render/tone_mapper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gpu/warm_up.h"
#include "render/setting_names.h"
#include "shared/wavefront.h"

namespace lavalight {
namespace {

constexpr const char* kKernelName = "tonemap";
constexpr const char* kDisplayName = "display";

// Finite, so that black stays black whatever the exposure.
float scaleOf(float exposureStops) {
    return std::min(std::exp2(exposureStops), std::numeric_limits<float>::max());
}

// 0: there is no such plane; the colour has the first word.
uint32_t wordOf(const FilmLayout& layout, uint32_t row) {
    const std::optional<size_t> plane = layout.find(row);
    return plane ? layout.firstWord(*plane) : 0;
}

ToneRange rangeOf(const ToneSettings& tone) {
    ToneRange range{};
    range.scale = scaleOf(tone.exposure);
    range.backdrop = tone.backdrop.value_or(glm::vec3(0.0f));
    range.hasBackdrop = tone.backdrop ? 1u : 0u;
    return range;
}

} // namespace

ToneMapper::ToneMapper(gpu::Device& device, const KernelSource& source)
    : device_(&device), display_(device, kDisplayName, 0, gpu::BufferUse::readback), commands_(device) {
    const gpu::KernelCode code = source(kKernelName);
    std::vector<const gpu::Kernel*> made;
    for (const SettingName<ToneCurve>& curve : settingNames<ToneCurve>()) {
        const std::array<gpu::SpecialisationConstant, 1> constants{
            {{CONSTANT_TONE_CURVE, static_cast<uint32_t>(curve.value)}}};
        made.push_back(&kernels_.try_emplace(curve.value, device, code, constants).first->second);
    }
    gpu::warmUp(device, made);
}

std::vector<uint32_t> ToneMapper::map(const Film& film, const ToneSettings& tone, size_t plane) {
    const FilmLayout& layout = film.layout();
    ToneRange range = rangeOf(tone);
    range.countWord = layout.countWord();
    range.firstWord = layout.firstWord(plane);
    range.plane = layout.planes()[plane].shape;
    if (plane == kColorPlane)
        range.coverageWord = wordOf(layout, kCoveragePlane);
    if (plane == kColorPlane || layout.find(kEmissionPlane) == plane || layout.find(kDirectPlane) == plane) {
        range.shadowWord = wordOf(layout, kShadowPlane);
        range.behindWord = wordOf(layout, kBehindPlane);
    }
    std::vector<uint32_t> pixels(size_t{film.width()} * film.height());
    for (const FilmBand& band : film.bands()) {
        const size_t first = size_t{band.firstRow} * film.width();
        mapBand(band.sums, kernels_.at(tone.curve), range,
                std::span(pixels).subspan(first, size_t{band.rows} * film.width()));
    }
    return pixels;
}

std::vector<uint32_t> ToneMapper::map(const Image& image, const Image* coverage, const ToneSettings& tone,
                                      const Image* shadow) {
    constexpr uint32_t kWords = 5; // R, G, B, coverage, shadow
    ToneRange range = rangeOf(tone);
    range.isImage = 1;
    range.plane = shapeOf(kColorPlane, 0);
    range.coverageWord = coverage != nullptr ? 3 : 0;
    range.shadowWord = shadow != nullptr ? 4 : 0;
    const size_t count = image.pixels.size();
    const uint64_t most = device_->limits().maxStorageBufferBytes / (kWords * sizeof(float));
    std::vector<uint32_t> pixels(count);
    for (size_t first = 0; first < count; first += most) {
        const size_t part = std::min<size_t>(most, count - first);
        std::vector<float> words(kWords * part);
        for (size_t i = 0; i < part; ++i) {
            for (glm::length_t c = 0; c < 3; ++c)
                words[static_cast<size_t>(c) * part + i] = image.pixels[first + i][c];
            words[3 * part + i] = coverage != nullptr ? coverage->pixels[first + i].x : 1.0f;
            words[4 * part + i] = shadow != nullptr ? shadow->pixels[first + i].x : 0.0f;
        }
        gpu::Buffer buffer(*device_, "image", words.size() * sizeof(float), gpu::BufferUse::storage);
        buffer.upload(std::span<const float>(words));
        mapBand(buffer, kernels_.at(tone.curve), range, std::span(pixels).subspan(first, part));
    }
    return pixels;
}

bool ToneMapper::isChanged(const KernelSource& source) const {
    return source(kKernelName).content != kernels_.begin()->second.code().content;
}

void ToneMapper::mapBand(const gpu::Buffer& sums, const gpu::Kernel& kernel, ToneRange range,
                         std::span<uint32_t> pixels) {
    if (display_.bytes() < pixels.size_bytes())
        display_ = gpu::Buffer(*device_, kDisplayName, pixels.size_bytes(), gpu::BufferUse::readback);
    gpu::ResourceTable resources;
    resources.set("Film", sums);
    resources.set("Display", display_);
    // Bound anew each time, for some microseconds: nothing here refers to a film that is gone.
    const gpu::BoundKernel bound(*device_, kernel, resources);
    const auto count = static_cast<uint32_t>(pixels.size());
    const uint32_t groups = (count + kWorkgroupSize - 1) / kWorkgroupSize;
    const uint32_t most = device_->limits().maxGroups;
    range.bandPixels = count;
    commands_.begin();
    for (uint32_t first = 0; first < groups; first += most) {
        range.firstPixel = first * kWorkgroupSize;
        commands_.dispatch(bound, std::min(most, groups - first), std::as_bytes(std::span(&range, 1)));
    }
    commands_.submitAndWait();
    display_.download(std::as_writable_bytes(pixels));
}

} // namespace lavalight
