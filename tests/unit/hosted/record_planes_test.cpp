// Tests of the planes that records have.
#include "hosted/record_planes.h"

#include <gtest/gtest.h>

namespace lavalight {
namespace {

TEST(RecordPlanes, AreThoseThatTheSceneNeeds) {
    EXPECT_EQ(recordPlanes(kFeatureSpecular | kFeatureTextures | kFeatureEnvironment), 0u);
    EXPECT_EQ(recordPlanes(kFeatureLightTree), kRecordState);
    EXPECT_EQ(recordPlanes(kFeatureGlass), kRecordState | kRecordShadowOrigin);
    EXPECT_EQ(recordPlanes(kFeatureDiffuseTransmission), kRecordState | kRecordShadowOrigin);
    // At boundaries of solids the two rays start at different points, whatever they are made of.
    EXPECT_EQ(recordPlanes(kFeatureSolids), kRecordShadowOrigin | kRecordInterior);
}

} // namespace
} // namespace lavalight
