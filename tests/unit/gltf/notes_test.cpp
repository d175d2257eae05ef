// Tests of names in messages.
#include "gltf/read/notes.h"

#include <gtest/gtest.h>

namespace lavalight::test {
namespace {

TEST(GltfNotes, LongNamesAreCutBetweenCharacters) {
    const std::string cut = describe("mesh", 3, "x" + std::string(31, 'y') + std::string(100, 'z'));
    EXPECT_EQ(cut, "mesh 3 \"x" + std::string(31, 'y') + std::string(32, 'z') + "...\"");
    std::string euros; // characters of three bytes: byte 64 lies within the 22nd
    for (int i = 0; i < 40; ++i)
        euros += "\xe2\x82\xac";
    EXPECT_EQ(describe("mesh", 0, euros), "mesh 0 \"" + euros.substr(0, 63) + "...\"");
}

TEST(GltfNotes, OneLineForAFindingWithTheFirstObjectsAndHowManyMore) {
    GltfNotes notes;
    for (int i = 0; i < 11; ++i)
        notes.addObject("is odd", describe("mesh", static_cast<size_t>(i), ""));
    notes.add("once");
    notes.add("once");
    ASSERT_EQ(notes.lines().size(), 2u);
    EXPECT_EQ(notes.lines().at(0),
              "is odd: mesh 0, mesh 1, mesh 2, mesh 3, mesh 4, mesh 5, mesh 6, mesh 7 and 3 more");
    EXPECT_EQ(notes.lines().at(1), "once");
}

} // namespace
} // namespace lavalight::test
