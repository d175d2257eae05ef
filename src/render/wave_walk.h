// The way of a render through its samples: phase by phase, in passes over the whole image, in waves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "film/raw_film.h"
#include "render/phase.h"
#include "shared/wavefront.h"

namespace lavalight {

// The next wave of a render. Passes take samples of all pixels, waves go through them band by band.
struct RenderPosition {
    uint32_t samplesDone = 0; // samples of every pixel by the passes before
    uint32_t passSamples = 0; // samples a pixel in this pass; 0: it is yet to start
    size_t band = 0;
    uint32_t pixel = 0; // next pixel of the band
};

struct Wave {
    const Transport* transport;
    size_t band;
    WaveRange range;
};

// What passes and waves are cut by.
struct WaveLimits {
    std::vector<uint32_t> bandPixels; // pixels of each band of the film; none has more than the first
    uint32_t planes = 1;              // planes of the film
    uint32_t waveSize = 0;            // path slots
    bool mayStop = false;             // whether the render may stop before all samples are taken
};

class WaveWalk {
  public:
    // At least one phase, one band and one slot.
    WaveWalk(std::vector<Phase> phases, WaveLimits limits);

    // Whether all samples of all phases are taken.
    [[nodiscard]] bool isDone() const { return position_.samplesDone >= samples_; }
    [[nodiscard]] double fractionDone() const;
    [[nodiscard]] const RenderPosition& position() const { return position_; }

    // The wave to render next, of at most `mostSlots` paths but at least one pixel's: the same one again
    // until goPast(). Not all samples may be taken yet.
    [[nodiscard]] Wave next(uint32_t mostSlots);
    void goPast(const Wave& wave);
    void startAgain() { position_ = {}; }

    // The position whatever the bands, and back to it. The pass must not take more samples at once than there
    // are slots.
    [[nodiscard]] FilmProgress progress() const;
    void continueFrom(const FilmProgress& progress);

  private:
    // The phase of the next sample, and the samples of the phases before it.
    [[nodiscard]] std::pair<const Phase*, uint32_t> phase() const;
    [[nodiscard]] uint32_t nextPass() const;

    std::vector<Phase> phases_;
    WaveLimits limits_;
    std::vector<uint32_t> firstPixels_; // the first of each band, in the image
    uint32_t pixels_ = 0;               // of the image
    uint32_t samples_ = 0;              // of each pixel, by all phases
    RenderPosition position_;
};

} // namespace lavalight
