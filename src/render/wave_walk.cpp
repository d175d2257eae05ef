#include "render/wave_walk.h"

#include <algorithm>
#include <cassert>

namespace lavalight {
namespace {

// Samples that a pixel takes while it is in the wave: they share one update of its film words, and the vector
// units trace their camera rays together.
constexpr uint32_t kSamplesTogether = 16;

// Mesa 22.3's lavapipe ends all loops of an invocation without a word after 65,535 turns in sum, and
// accumulate makes four turns a sample and plane: beyond 16,000 samples it lost some (measured: 1x1 pixel,
// 65536 samples in one wave).
constexpr uint32_t kMostSamplesTogether = 4096; // divided by the film's planes

} // namespace

WaveWalk::WaveWalk(std::vector<Phase> phases, WaveLimits limits)
    : phases_(std::move(phases)), limits_(std::move(limits)) {
    assert(!phases_.empty() && !limits_.bandPixels.empty() && limits_.waveSize > 0);
    for (const uint32_t pixels : limits_.bandPixels) {
        firstPixels_.push_back(pixels_);
        pixels_ += pixels;
    }
    for (const Phase& phase : phases_)
        samples_ += phase.samples;
}

std::pair<const Phase*, uint32_t> WaveWalk::phase() const {
    uint32_t before = 0;
    for (const Phase& phase : phases_) {
        if (position_.samplesDone - before < phase.samples)
            return {&phase, before};
        before += phase.samples;
    }
    assert(false && "all samples are taken");
    return {&phases_.back(), before};
}

// More samples than kSamplesTogether only where the wave would not be full. A render that may stop at any
// moment starts with passes of few samples, so that every pixel has some.
uint32_t WaveWalk::nextPass() const {
    const auto [phase, before] = this->phase();
    const uint32_t done = position_.samplesDone;
    const uint32_t fitting = std::clamp(limits_.waveSize / limits_.bandPixels.front(), kSamplesTogether,
                                        kMostSamplesTogether / limits_.planes);
    const uint32_t count = std::min(before + phase->samples - done, fitting);
    return limits_.mayStop ? std::min(count, std::max(1u, done)) : count;
}

Wave WaveWalk::next(uint32_t mostSlots) {
    assert(!isDone());
    RenderPosition& at = position_;
    if (at.passSamples == 0)
        at.passSamples = nextPass();
    const auto [phase, before] = this->phase();
    const uint32_t first = firstPixels_[at.band];
    const uint32_t slots = std::min(mostSlots, limits_.waveSize);
    const uint32_t count = std::clamp(slots / at.passSamples, 1u, limits_.bandPixels[at.band] - at.pixel);
    WaveRange range{};
    range.firstPixel = first + at.pixel;
    range.pixelCount = count;
    range.firstSample = phase->firstSample + at.samplesDone - before;
    range.sampleCount = at.passSamples;
    range.bandFirstPixel = first;
    return {phase->transport, at.band, range};
}

void WaveWalk::goPast(const Wave& wave) {
    RenderPosition& at = position_;
    at.pixel += wave.range.pixelCount;
    if (at.pixel == limits_.bandPixels[at.band]) {
        at.pixel = 0;
        ++at.band;
    }
    if (at.band == limits_.bandPixels.size()) {
        at.band = 0;
        at.samplesDone += at.passSamples;
        at.passSamples = 0;
    }
}

double WaveWalk::fractionDone() const {
    const double before = firstPixels_[position_.band] + position_.pixel;
    return (position_.samplesDone + position_.passSamples * before / pixels_) / samples_;
}

FilmProgress WaveWalk::progress() const {
    return {position_.samplesDone, position_.passSamples, firstPixels_[position_.band] + position_.pixel};
}

void WaveWalk::continueFrom(const FilmProgress& progress) {
    assert(progress.passSamples <= limits_.waveSize);
    const uint32_t bandPixels = limits_.bandPixels.front(); // of each band but the last
    position_ = {progress.samples, progress.passSamples, progress.passPixels / bandPixels,
                 progress.passPixels % bandPixels};
}

} // namespace lavalight
