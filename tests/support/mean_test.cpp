#include "support/mean_test.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "compare/statistics.h"

namespace lavalight::test {
namespace {

// A relative difference of two means.
struct Difference {
    double value = 0.0;
    double deviation = 0.0; // standard
    std::string place;
};

double sumOf(const Image& variance, glm::length_t channel) {
    double sum = 0.0;
    for (const glm::vec3& pixel : variance.pixels)
        sum += pixel[channel];
    return sum;
}

// Differences of the tiles that are precise enough, both by the image's own variance and by the reference's,
// scaled by how much noisier the image is as a whole. The image's variance alone would prefer tiles that
// missed rare bright samples, which seem precise and are too dark; the reference's alone would not see where
// an estimator is worse than elsewhere.
std::vector<Difference> tileDifferences(const Rendering& image, const Rendering& reference, uint32_t side,
                                        glm::length_t channel) {
    const Rendering ti = downsample(image, side);
    const Rendering tr = downsample(reference, side);
    const double ofReference = sumOf(tr.variance(), channel);
    const double noisier =
        ofReference > 0.0 ? std::max(1.0, sumOf(ti.variance(), channel) / ofReference) : 1.0;
    std::vector<Difference> differences;
    for (size_t i = 0; i < tr.radiance().pixels.size(); ++i) {
        const double mean = tr.radiance().pixels[i][channel];
        const double variance = tr.variance().pixels[i][channel];
        const double own = ti.variance().pixels[i][channel];
        if (!(std::sqrt(std::max(noisier * variance, own)) < kPrecision * mean))
            continue;
        // What has no noise, as emission seen directly, is rounded all the same: half a unit in the last
        // place each.
        const double deviation = std::sqrt(variance + own) / mean + 0x1p-23;
        differences.push_back({ti.radiance().pixels[i][channel] / mean - 1.0, deviation,
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
        if (const double z = std::abs(difference.value) / difference.deviation; !(z <= comparison.worstZ)) {
            comparison.worstZ = z;
            comparison.worst = difference.place;
        }
    };
    for (const uint32_t side : kTileSides)
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            const std::vector<Difference> tiles = tileDifferences(image, reference, side, channel);
            if (tiles.empty())
                continue;
            std::for_each(tiles.begin(), tiles.end(), judge);
            const Difference all = meanOf(tiles);
            judge(all);
            ofAll = std::min(ofAll, all.deviation);
            ofTile = std::min(ofTile, medianDeviation(tiles));
            const double possible = std::ceil(image.radiance().width / double(side)) *
                                    std::ceil(image.radiance().height / double(side));
            comparison.share = std::max(comparison.share, static_cast<double>(tiles.size()) / possible);
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
