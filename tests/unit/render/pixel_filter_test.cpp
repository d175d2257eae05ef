// Tables of pixel filters: samples drawn by them have the filter's moments.
#include <cmath>

#include <gtest/gtest.h>

#include "render/pixel_filter.h"

namespace lavalight {
namespace {

constexpr PixelFilter kFilters[] = {PixelFilter::box, PixelFilter::tent, PixelFilter::gaussian,
                                    PixelFilter::blackmanHarris, PixelFilter::mitchell};

EstimatorSettings settingsOf(PixelFilter filter) {
    EstimatorSettings settings;
    settings.pixelFilter = filter;
    return settings;
}

// The offset and sign that pixel_filter.glsl has for a random number, on the side away from the corner.
struct Drawn {
    double offset;
    double sign;
};

Drawn draw(const FilterTable& table, double within) {
    const double w = (1.0 - std::sqrt(1.0 - within)) * kFilterIntervals;
    const size_t i = std::min<size_t>(static_cast<size_t>(w), kFilterIntervals - 1);
    const double part = w - static_cast<double>(i);
    return {table.nodes[i] + part * (table.nodes[i + 1] - table.nodes[i]),
            within < table.positive ? 1.0 : -1.0};
}

// Integral of x^power times the filter over that of the filter.
double momentOf(PixelFilter filter, double radius, int power) {
    constexpr int kSteps = 100000;
    double sum = 0.0;
    double all = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double x = (i + 0.5) / kSteps;
        sum += std::pow(radius * x, power) * filterValue(filter, x);
        all += filterValue(filter, x);
    }
    return sum / all;
}

TEST(PixelFilters, SamplesHaveTheMomentsOfTheFilter) {
    for (const PixelFilter filter : kFilters) {
        SCOPED_TRACE(static_cast<int>(filter));
        const EstimatorSettings settings = settingsOf(filter);
        const FilterTable table = filterTable(settings);
        constexpr int kSamples = 200000;
        for (const int power : {0, 1, 2, 4}) {
            double sum = 0.0;
            for (int i = 0; i < kSamples; ++i) {
                const Drawn drawn = draw(table, (i + 0.5) / kSamples);
                sum += drawn.sign * std::sqrt(table.scale) * std::pow(drawn.offset, power) / kSamples;
            }
            EXPECT_NEAR(sum, momentOf(filter, filterRadius(settings), power), 1e-3) << power;
        }
    }
}

// Integrals of the polynomials: between 8/7 and 2 the filter is negative.
TEST(PixelFilters, MitchellHasTheNegativeShareOfItsPolynomials) {
    const FilterTable table = filterTable(settingsOf(PixelFilter::mitchell));
    EXPECT_NEAR(table.positive, 0.9673, 1e-4);
    for (const PixelFilter filter : kFilters)
        EXPECT_EQ(hasNegativeWeights(settingsOf(filter)), filterTable(settingsOf(filter)).positive < 1.0f);
}

TEST(PixelFilters, OffsetsEndAtTheRadius) {
    for (const PixelFilter filter : kFilters) {
        EstimatorSettings settings = settingsOf(filter);
        settings.filterRadius = 0.75f;
        const FilterTable table = filterTable(settings);
        EXPECT_EQ(table.nodes.front(), 0.0f);
        EXPECT_EQ(table.nodes.back(), 0.75f);
        for (size_t i = 1; i < table.nodes.size(); ++i)
            EXPECT_GT(table.nodes[i], table.nodes[i - 1]) << i;
    }
    EXPECT_TRUE(isUnitBox(EstimatorSettings()));
    EXPECT_FALSE(isUnitBox(settingsOf(PixelFilter::tent)));
}

TEST(PixelFilters, APointIsTheMiddleAloneWhateverRadiusIsAskedFor) {
    EstimatorSettings settings = settingsOf(PixelFilter::point);
    settings.filterRadius = 0.75f;
    EXPECT_EQ(filterRadius(settings), 0.0f);
    EXPECT_FALSE(isUnitBox(settings));
    const FilterTable table = filterTable(settings);
    for (const float node : table.nodes)
        EXPECT_EQ(node, 0.0f);
    EXPECT_EQ(table.positive, 1.0f);
    EXPECT_EQ(table.scale, 1.0f);
}

} // namespace
} // namespace lavalight
