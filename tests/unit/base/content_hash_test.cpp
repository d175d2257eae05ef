// Hashes of content.
#include "base/content_hash.h"

#include <gtest/gtest.h>

namespace lavalight {
namespace {

std::string hashOf(const std::vector<std::string>& texts) {
    ContentHash hash;
    for (const std::string& text : texts)
        hash.add(text);
    return hash.text();
}

// XXH3's own test: 128 bits of nothing.
TEST(ContentHash, IsXxh3) {
    EXPECT_EQ(ContentHash().text(), "99aa06d3014798d86001c324468d497f");
}

TEST(ContentHash, TellsContentsApartAndWhereTheyEnd) {
    EXPECT_EQ(hashOf({"ab", "c"}), hashOf({"ab", "c"}));
    EXPECT_NE(hashOf({"ab", "c"}), hashOf({"a", "bc"}));
    EXPECT_NE(hashOf({"ab"}), hashOf({"ab", ""}));
    EXPECT_NE(hashOf({"ab"}), hashOf({"ac"}));
}

TEST(ContentHash, OfRecordsIsThatOfTheirBytes) {
    ContentHash records;
    records.add(std::vector<uint32_t>{0x64636261u});
    EXPECT_EQ(records.text(), hashOf({"abcd"}));
}

} // namespace
} // namespace lavalight
