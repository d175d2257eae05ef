#include "support/mean_test.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "compare/welch.h"

namespace lavalight::test {
namespace {

// A relative difference of two means.
struct Difference {
    double value = 0.0;
    double deviation = 0.0; // standard
    std::string place;
};

// How many times noisier the image is than the reference, as a whole; at least 1.
double noiseRatio(const std::vector<TileDifference>& tiles, int channel) {
    double ofImage = 0.0;
    double ofReference = 0.0;
    for (const TileDifference& tile : tiles) {
        ofImage += tile.imageVariance[channel];
        ofReference += tile.referenceVariance[channel];
    }
    return ofReference > 0.0 ? std::max(1.0, ofImage / ofReference) : 1.0;
}

// Differences of the tiles that are precise enough, both by the image's own variance and by the reference's,
// scaled by how much noisier the image is as a whole. The image's variance alone would prefer tiles that
// missed rare bright samples, which seem precise and are too dark; the reference's alone would not see where
// an estimator is worse than elsewhere.
std::vector<Difference> preciseDifferences(const std::vector<TileDifference>& tiles, uint32_t side,
                                           int channel) {
    const double noisier = noiseRatio(tiles, channel);
    std::vector<Difference> differences;
    for (size_t i = 0; i < tiles.size(); ++i) {
        const double mean = tiles[i].reference[channel];
        const double expected = noisier * tiles[i].referenceVariance[channel];
        if (!(std::sqrt(std::max(expected, tiles[i].imageVariance[channel])) < kPrecision * mean))
            continue;
        // What has no noise, as emission seen directly, is rounded all the same: half a unit in the last
        // place each.
        const double deviation = std::sqrt(tiles[i].variance[channel]) / mean + 0x1p-23;
        differences.push_back({tiles[i].difference[channel] / mean, deviation,
                               fmt::format("tile {} of {} pixels a side, channel {}", i, side, channel)});
    }
    return differences;
}

Difference meanOf(const std::vector<Difference>& differences) {
    Difference mean{0.0, 0.0, "all tiles"};
    for (const Difference& difference : differences) {
        mean.value += difference.value;
        mean.deviation += difference.deviation * difference.deviation;
    }
    mean.value /= static_cast<double>(differences.size());
    mean.deviation = std::sqrt(mean.deviation) / static_cast<double>(differences.size());
    return mean;
}

double medianDeviation(std::vector<Difference> differences) {
    const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
    std::nth_element(differences.begin(), middle, differences.end(),
                     [](const Difference& a, const Difference& b) { return a.deviation < b.deviation; });
    return middle->deviation;
}

} // namespace

double twoSidedQuantile(double probability) {
    double low = 0.0;
    double high = 40.0;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::sqrt(2.0)) > probability ? low : high) = middle;
    }
    return low;
}

MeanComparison compareMeans(const Rendering& image, const Rendering& reference) {
    MeanComparison comparison;
    double ofAll = std::numeric_limits<double>::infinity();
    double ofTile = ofAll;
    const auto judge = [&](const Difference& difference) {
        ++comparison.tests;
        if (const double z = absoluteZ(difference.value, difference.deviation); z > comparison.worstZ) {
            comparison.worstZ = z;
            comparison.worst = difference.place;
        }
    };
    const Estimate ofImage{&image.radiance(), &image.variance()};
    const Estimate ofReference{&reference.radiance(), &reference.variance()};
    for (const uint32_t side : kTileSides) {
        const std::vector<TileDifference> tiles = tileDifferences(ofImage, ofReference, side);
        for (int channel = 0; channel < 3; ++channel) {
            const std::vector<Difference> precise = preciseDifferences(tiles, side, channel);
            if (precise.empty())
                continue;
            std::for_each(precise.begin(), precise.end(), judge);
            const Difference all = meanOf(precise);
            judge(all);
            ofAll = std::min(ofAll, all.deviation);
            ofTile = std::min(ofTile, medianDeviation(precise));
            comparison.share = std::max(comparison.share, static_cast<double>(precise.size()) /
                                                              static_cast<double>(tiles.size()));
        }
    }
    comparison.limit = twoSidedQuantile(kFalseAlarm / std::max(1u, comparison.tests));
    comparison.visibleInTile = comparison.limit * ofTile;
    comparison.visibleBias = comparison.limit * ofAll;
    return comparison;
}

std::string MeanComparison::text() const {
    return fmt::format(
        "largest |z| {:.2f} of {:.2f} allowed{}; {} tests, {:.0f} % of the tiles count; a bias of {:.2f} % "
        "everywhere or of {:.2f} % in a tile would show",
        worstZ, limit, same() ? "" : " (" + worst + ")", tests, 100.0 * share, 100.0 * visibleBias,
        100.0 * visibleInTile);
}

} // namespace lavalight::test
