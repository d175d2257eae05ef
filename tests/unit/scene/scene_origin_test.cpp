// Where a scene's own origin is put, by what is small and what the camera shows.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "scene/scene_origin.h"

namespace lavalight {
namespace {

VertexRun box(const glm::dvec3& center, double halfSide) {
    return {.lower = center - halfSide, .upper = center + halfSide};
}

// A perspective camera whose image is as high as its distance.
Viewpoint at(const glm::dvec3& position) {
    return {position, 0.0, 1.0};
}

// The largest ratio of a coordinate to the size of its box, or to what the camera shows there.
double worstAbout(const glm::dvec3& origin, const std::vector<VertexRun>& runs, const Viewpoint& view) {
    double worst = 0.0;
    for (const VertexRun& run : runs) {
        const double need = std::max(run.size(), view.height + view.slope * run.distance(view.position));
        worst = std::max(worst, box(run.lower - origin, 0.0).reach() / need);
        worst = std::max(worst, box(run.upper - origin, 0.0).reach() / need);
    }
    return worst;
}

TEST(SceneOrigin, SmallThingsNearTheCameraWinOverLargeAndDistantOnes) {
    const glm::dvec3 cup(4e5, 100.0, -3e5);
    // A cup of 0.1 m on a map of 1000 km, with a mountain.
    const std::vector<VertexRun> runs{box({0, 0, 0}, 5e5), box({1e5, 0, 1e5}, 2e3), box(cup, 0.05)};
    const Viewpoint view = at(cup + glm::dvec3(0, 0, 0.5));
    const glm::dvec3 origin = chooseOrigin(runs, view);
    EXPECT_LT(glm::length(glm::dvec2(origin.x - cup.x, origin.z - cup.z)), 2.0);
    EXPECT_LT(worstAbout(origin, runs, view), 4.0);
    EXPECT_GT(worstAbout(glm::dvec3(0.0), runs, view), 1e5);
}

TEST(SceneOrigin, AnOrthographicCameraMayStandFarFromWhatItShows) {
    const std::vector<VertexRun> runs{box({0, 0, 3e6}, 1.0)};
    const glm::dvec3 origin = chooseOrigin(runs, Viewpoint{{0, 0, 3e6 + 100.0}, 3.0, 0.0});
    EXPECT_NEAR(origin.z, 3e6 + 50.0, 2.0) << "between both";
}

TEST(SceneOrigin, HeightOfAnOrthographicImageIsAllThatHasToBeResolved) {
    const std::vector<VertexRun> runs{box({3e6, 0, 0}, 1.0), box({3e6 + 1000.0, 0, 0}, 0.001)};
    const glm::dvec3 origin = chooseOrigin(runs, Viewpoint{{3e6 + 1000.0, 0, 0}, 1000.0, 0.0});
    EXPECT_NEAR(origin.x, 3e6 + 500.0, 256.0); // the small box would win
}

TEST(SceneOrigin, ViewpointsShowWhatTheirCamerasDo) {
    Camera camera;
    camera.verticalFov = 2.0f * std::atan(0.75f);
    camera.halfHeight = 3.0f;
    Viewpoint view = viewpointOf(camera, {1, 2, 3});
    EXPECT_EQ(view.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(view.height, 0.0);
    EXPECT_NEAR(view.slope, 1.5, 1e-6);
    camera.projection = Projection::orthographic;
    view = viewpointOf(camera, {1, 2, 3});
    EXPECT_EQ(view.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(view.height, 6.0);
    EXPECT_EQ(view.slope, 0.0);
}

// A coordinate of 32 needs leaves the origin where it is; the other axes do not follow one that is longer.
TEST(SceneOrigin, AnAxisThatHasNotMuchToGainStaysAtZero) {
    const auto of = [](const glm::dvec3& center) {
        return chooseOrigin(std::vector{box(center, 1.0)}, std::nullopt); // of 2 m
    };
    EXPECT_EQ(of({62.9, -62.9, 0}), glm::dvec3(0.0));
    EXPECT_NEAR(of({63.1, 0, 0}).x, 63.1, 1.0);
    EXPECT_NEAR(of({0, -63.1, 0}).y, -63.1, 1.0);
    const glm::dvec3 origin = of({62.9, 3e6, -62.9});
    EXPECT_EQ(origin, glm::dvec3(0, 3e6, 0));
}

TEST(SceneOrigin, IsTheBestThatThereIsAndHasFewBits) {
    const std::vector<VertexRun> runs{box({3e6 + 1.0, 0, 0}, 1.0), box({3e6 + 9.0, 0, 0}, 4.0),
                                      box({3e6 + 1e4, 0, 0}, 50.0)};
    const Viewpoint view = at({3e6 + 3.0, 0, 5.0});
    const double found = worstAbout(chooseOrigin(runs, view), runs, view);
    for (double x = 3e6 - 100.0; x < 3e6 + 100.0; x += 0.125) // rounding may cost half a need
        EXPECT_GE(worstAbout({x, 0, 0}, runs, view) + 0.5, found) << x;
    const double origin = chooseOrigin(runs, view).x;
    EXPECT_EQ(origin, std::round(origin));
}

TEST(SceneOrigin, WithoutACameraTheWholeSceneIsShown) {
    const std::vector<VertexRun> far{box({1e6, 0, 0}, 1.0), box({1e6 + 10.0, 0, 0}, 0.001)};
    EXPECT_NEAR(chooseOrigin(far, std::nullopt).x, 1e6 + 5.0, 9.0);
    const std::vector<VertexRun> wide{box({1e6, 0, 0}, 1.0), box({1e6 + 1000.0, 0, 0}, 0.001)};
    EXPECT_NEAR(chooseOrigin(wide, std::nullopt).x, 1e6 + 500.0, 256.0) << "what is small has no more weight";
    const std::vector<VertexRun> around{box({1e6, 0, 0}, 1.0), box({-1e6, 0, 0}, 1.0)};
    EXPECT_EQ(chooseOrigin(around, std::nullopt), glm::dvec3(0.0));
    EXPECT_EQ(chooseOrigin({}, std::nullopt), glm::dvec3(0.0));
    EXPECT_EQ(chooseOrigin(std::vector{box({1e6, 0, 0}, 0.0)}, std::nullopt), glm::dvec3(0.0));
}

TEST(SceneOrigin, CoarseIsWhatHasFewStepsForItsSize) {
    EXPECT_FALSE(isCoarse(box({1e5, 0, 0}, 1.0)));
    EXPECT_TRUE(isCoarse(box({1e6, 0, 0}, 1.0)));
    EXPECT_FALSE(isCoarse(box({1e6, 0, 0}, 100.0)));
    EXPECT_FALSE(isCoarse(box({1e6, 0, 0}, 0.0))); // nothing to resolve
    const auto worst = findCoarse(std::vector{box({1e6, 0, 0}, 1.0), box({0, 1e8, 0}, 2.0)});
    ASSERT_TRUE(worst);
    EXPECT_EQ(worst->resolution, 8.0);
    EXPECT_EQ(worst->size, 4.0);
    EXPECT_FALSE(findCoarse(std::vector{box({0, 0, 0}, 1.0)}));
}

TEST(VertexRuns, AreCutWhereTheyAreLongOrTheFileGoesOnElsewhere) {
    VertexRuns runs;
    runs.begin(3, 150);
    for (int i = 0; i < 150; ++i)
        runs.add({i, 0, 0});
    ASSERT_EQ(runs.all().size(), 2u); // 64, and 86 rather than 64 and 22
    EXPECT_EQ(runs.all()[0].upper.x, 63.0);
    EXPECT_EQ(runs.all()[1].lower.x, 64.0);
    EXPECT_EQ(runs.all()[1].upper.x, 149.0);
    EXPECT_EQ(runs.all()[1].mesh, 3u);
    runs.begin(4, 6);
    for (const double x : {0.0, 1.0, 2.0, 1e6, 1e6 + 1.0, 1e6 + 2.0})
        runs.add({x, 0, 0});
    ASSERT_EQ(runs.all().size(), 4u);
    EXPECT_EQ(runs.all()[2].size(), 2.0);
    EXPECT_EQ(runs.all()[3].size(), 2.0);
}

TEST(VertexRuns, PassOverWhatIsNoPosition) {
    VertexRuns runs;
    runs.begin(0, 4);
    for (const double x : {std::numeric_limits<double>::quiet_NaN(), 1e19, 1.0, 2.0})
        runs.add({x, 0, 0});
    ASSERT_EQ(runs.all().size(), 1u);
    EXPECT_EQ(runs.all()[0].size(), 1.0);
}

} // namespace
} // namespace lavalight
