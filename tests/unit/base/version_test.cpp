#include "base/version.h"

#include <regex>

#include <gtest/gtest.h>

namespace lavalight {
namespace {

TEST(Version, IsThatOfTheBuild) {
    EXPECT_EQ(kVersion, LAVALIGHT_VERSION);
}

TEST(Version, CommitIsAHashThatSaysWhetherItIsAll) {
    EXPECT_TRUE(std::regex_match(std::string(kCommit), std::regex("([0-9a-f]{12,40}(-dirty)?)?"))) << kCommit;
}

TEST(Version, TextIsVersionAndCommit) {
    EXPECT_EQ(versionText(), kCommit.empty() ? std::string(kVersion)
                                             : std::string(kVersion) + " (" + std::string(kCommit) + ")");
}

} // namespace
} // namespace lavalight
