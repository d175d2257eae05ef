// What `lavalight compare` finds: how far an image is from its reference, and whether that passes for equal.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/flip.h"
#include "compare/statistics.h"
#include "compare/welch.h"
#include "image/exr.h"
#include "image/image.h"
#include "image/rendering.h"

namespace lavalight {

// Either radiance (EXR), or what a display showed of it (PNG), made linear.
struct ComparedImage {
    std::string name;
    ExrFile content;
    bool isDisplayed = false;
};

// Throws Error for whatever is neither an EXR nor a PNG file.
[[nodiscard]] ComparedImage readCompared(const std::string& path);

// What is asked of the image to be equal to the reference. With none given: the Z-test where both have
// variances and a pixel of two samples, else relMSE of kDefaultRelMse. Layers besides the colour are asked
// for the same, but for FLIP; those without variances for relMSE in place of the Z-test.
struct Criteria {
    std::optional<double> relMse;       // at most
    std::optional<double> flip;         // mean FLIP, at most
    std::optional<double> significance; // how often the Z-test may take equal renders for different ones
};

// The layer of opacity; that of another layer bears its name and ".A". An image without one is opaque, beside
// an image that has it.
inline constexpr const char* kAlphaLayer = "A";

inline constexpr const char* kChannelNames = "RGB";
// Two unrelated images are around 1; two noisy renders of one scene below 0.1.
inline constexpr double kDefaultRelMse = 0.01;
// One false alarm in 10,000 comparisons.
inline constexpr double kDefaultSignificance = 1e-4;

struct Verdict {
    std::string criterion;
    double value = 0.0;
    double limit = 0.0;
    bool passed = false;
    std::string where; // the place that is furthest from equal

    [[nodiscard]] bool isZTest() const { return criterion.starts_with("Z-test"); }
};

// The Z-test of each pixel, of tiles, and of the whole image.
struct ZTestLevel {
    const char* name;
    const char* jsonName;
    uint32_t tileSize;
    WelchTest test;
};

inline constexpr float kZLimit = 3.3f; // a standard normal deviate is beyond it once in a thousand times
// Pixels; averages 256 of them: finds biases a sixteenth of what one pixel shows.
inline constexpr uint32_t kZTileSize = 16;

struct ZTests {
    std::string variancesOf; // "both", "image" or "reference"; an image without variance counts as exact
    std::array<ZTestLevel, 3> levels;

    // The smallest p-value of all, times the number of tests of its level and the number of levels
    // (Bonferroni).
    [[nodiscard]] double p() const;
    [[nodiscard]] const ZTestLevel& worst() const; // the level that it is of
};

// A layer that both have besides the colour, or alpha that one has.
struct LayerComparison {
    std::string name;
    std::vector<std::string> channels;
    double rmse = 0.0;
    double relMse = 0.0;
    std::string where;            // the pixel that contributes most to relMse
    std::optional<ZTests> zTests; // absent if neither has variances of it
};

struct Comparison {
    uint32_t width = 0;
    uint32_t height = 0;
    double rmse = 0.0;
    double relMse = 0.0;
    double trimmedRelMse = 0.0;
    MeanDifference meanDifference;
    uint64_t nonFiniteImage = 0;
    bool isHdrFlip = false;
    FlipMap flip;
    std::optional<ZTests> zTests; // absent if neither image has variances
    std::vector<LayerComparison> layers;
    std::vector<Verdict> verdicts; // verdict on the colour, then on each layer

    [[nodiscard]] bool isEqual() const; // whether all verdicts are
};

// Throws Error where the question has no answer: sizes differ, the reference is not finite, radiance against
// a displayed picture, a Z-test without variances.
[[nodiscard]] Comparison compare(const ComparedImage& image, const ComparedImage& reference,
                                 const Criteria& criteria);

} // namespace lavalight
