// A render takes every sample of every pixel once, whatever cuts it up.
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/wave_walk.h"

namespace lavalight::test {
namespace {

constexpr uint32_t kFirstPhase = 20; // samples, and more than one pass takes
constexpr uint32_t kSecondPhase = 7;

Transport named(std::string_view name) {
    Transport transport = kPathTransport;
    transport.name = name;
    return transport;
}

const Transport kFirst = named("first");
const Transport kSecond = named("second");

// Two phases, whose samples are far apart, over two bands.
WaveWalk twoPhases(uint32_t waveSize, bool mayStop = false) {
    return {{{&kFirst, 0, kFirstPhase}, {&kSecond, 1000, kSecondPhase}},
            {.bandPixels = {30, 10}, .planes = 1, .waveSize = waveSize, .mayStop = mayStop}};
}

// How often each sample of each pixel is taken, by the name of its transport.
using Taken = std::map<std::pair<uint32_t, uint32_t>, std::vector<std::string_view>>;

void take(const Wave& wave, Taken& taken) {
    const WaveRange& range = wave.range;
    for (uint32_t pixel = 0; pixel < range.pixelCount; ++pixel)
        for (uint32_t sample = 0; sample < range.sampleCount; ++sample)
            taken[{range.firstPixel + pixel, range.firstSample + sample}].push_back(wave.transport->name);
}

Taken everySample() {
    Taken taken;
    for (uint32_t pixel = 0; pixel < 40; ++pixel) {
        for (uint32_t sample = 0; sample < kFirstPhase; ++sample)
            taken[{pixel, sample}] = {"first"};
        for (uint32_t sample = 1000; sample < 1000 + kSecondPhase; ++sample)
            taken[{pixel, sample}] = {"second"};
    }
    return taken;
}

TEST(WaveWalk, TakesEverySampleOfEveryPhaseOnceByItsTransport) {
    for (const uint32_t waveSize : {1u, 64u, 1000u, 100000u})
        for (const bool mayStop : {false, true}) {
            WaveWalk walk = twoPhases(waveSize, mayStop);
            Taken taken;
            while (!walk.isDone()) {
                const Wave wave = walk.next(waveSize);
                EXPECT_EQ(wave.range.bandFirstPixel, wave.band == 0 ? 0u : 30u);
                take(wave, taken);
                walk.goPast(wave);
            }
            EXPECT_EQ(taken, everySample()) << waveSize;
            EXPECT_EQ(walk.fractionDone(), 1.0);
        }
}

TEST(WaveWalk, AWaveIsTheNextOneUntilItIsPassed) {
    WaveWalk walk = twoPhases(64);
    const Wave first = walk.next(64);
    EXPECT_EQ(walk.next(64).range.firstPixel, first.range.firstPixel);
    walk.goPast(first);
    EXPECT_EQ(walk.next(64).range.firstPixel, first.range.firstPixel + first.range.pixelCount);
}

// As a checkpoint does: what was taken before, and what is taken from there on, is everything once.
TEST(WaveWalk, GoesOnFromAnyPositionInAnyPhase) {
    for (size_t cut = 0; cut < 40; ++cut) {
        WaveWalk walk = twoPhases(256);
        Taken taken;
        for (size_t wave = 0; wave < cut && !walk.isDone(); ++wave) {
            const Wave next = walk.next(256);
            take(next, taken);
            walk.goPast(next);
        }
        WaveWalk later = twoPhases(256);
        later.continueFrom(walk.progress());
        EXPECT_EQ(later.fractionDone(), walk.fractionDone());
        while (!later.isDone()) {
            const Wave next = later.next(256);
            take(next, taken);
            later.goPast(next);
        }
        EXPECT_EQ(taken, everySample()) << "cut after " << cut << " waves";
    }
}

TEST(WaveWalk, ARenderThatMayStopSoonHasASampleOfEveryPixel) {
    WaveWalk walk = twoPhases(100000, true);
    EXPECT_EQ(walk.next(100000).range.sampleCount, 1u);
    EXPECT_GT(twoPhases(100000, false).next(100000).range.sampleCount, 1u);
}

} // namespace
} // namespace lavalight::test
