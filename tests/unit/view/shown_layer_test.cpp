// Which pictures of an image can be chosen, and what they ask of the film.
#include "view/shown_layer.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "render/settings.h"
#include "view/view_state.h"

namespace lavalight::test {
namespace {

TEST(ShownLayer, ListHoldsColourDenoisedAndEachLayerThatAovOffers) {
    std::vector<std::string> names;
    for (const ShownLayer& shown : shownLayers())
        names.push_back(nameOf(shown));
    const std::set<std::string> unique(names.begin(), names.end());
    EXPECT_EQ(names[0], "color");
    EXPECT_EQ(names[1], "denoised");
    EXPECT_EQ(names.size(), 2 + offeredRows().size() - 1) << "all but motion";
    EXPECT_EQ(unique.size(), names.size());
    for (const char* name : {"albedo", "normal", "depth", "position", "emission"})
        EXPECT_TRUE(unique.contains(name)) << name;
    for (const char* name : {"coverage", "hits", "guide-albedo", "guide-normal", "motion"})
        EXPECT_FALSE(unique.contains(name)) << name;
}

TEST(ShownLayer, StepsGoAroundAndBack) {
    const std::vector<ShownLayer> all = shownLayers();
    ShownLayer shown;
    for (const ShownLayer& wanted : all) {
        EXPECT_EQ(shown, wanted);
        shown = stepped(shown, 1, true);
    }
    EXPECT_EQ(shown, all.front());
    EXPECT_EQ(stepped(shown, -1, true), all.back());
    EXPECT_EQ(stepped(ShownLayer{}, 1, false), all[2]) << "nothing can be denoised";
}

TEST(ShownLayer, OneLayerBringsThePlanesOfAllAndTheDenoisedColourItsGuides) {
    EXPECT_EQ(planesFor(ShownLayer{}), 0u);
    EXPECT_EQ(planesFor(kDenoisedColor), kDenoisingLayers);
    EXPECT_EQ(planesFor({kDepthPlane, false}), planesFor({kAlbedoPlane, false}));
    EXPECT_NE(planesFor({kDepthPlane, false}) & 1u << kDepthPlane, 0u);
}

TEST(ShownLayer, PlanesStayWhenTheColourIsShownAgain) {
    ViewState view{"", {}, nullptr, CameraRig({}, {}), {}, {}, {}, {}};
    stepShown(view, 0, -1); // the last layer
    askForPlanes(view);
    const uint32_t planes = view.settings.layers;
    EXPECT_EQ(planes, planesFor({kDepthPlane, false}));
    EXPECT_EQ(view.asked, planes);
    stepShown(view, 0, 1);
    askForPlanes(view);
    EXPECT_EQ(view.shown[0], ShownLayer{});
    EXPECT_EQ(view.settings.layers, planes) << "to lose them would restart the image";
    toggleDenoised(view, 0);
    askForPlanes(view);
    EXPECT_EQ(view.settings.layers, planes | kDenoisingLayers);
    EXPECT_EQ(view.asked, planes) << "guides are not saved";
    toggleDenoised(view, 0);
    EXPECT_EQ(view.shown[0], ShownLayer{});
}

TEST(ShownLayer, WithoutADenoiserNothingIsDenoised) {
    ViewState view{"", {}, nullptr, CameraRig({}, {}), {}, {}, {}, {}};
    view.whyNotDenoised = "cannot denoise";
    toggleDenoised(view, 0);
    EXPECT_EQ(view.shown[0], ShownLayer{});
}

} // namespace
} // namespace lavalight::test
