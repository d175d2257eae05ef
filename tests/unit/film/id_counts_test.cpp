// Ids of pixels, and Cryptomatte's hashes.
#include <bit>

#include <gtest/gtest.h>

#include "film/cryptomatte.h"
#include "film/id_layers.h"

namespace lavalight {
namespace {

TEST(IdCounts, TheLargestCountComesFirstAndTiesGoToTheLowestId) {
    IdCounts counts(2);
    for (const uint32_t id : {7u, 3u, 3u, 9u, 7u, 2u})
        counts.add(1, id);
    EXPECT_TRUE(counts.ranked(0).empty());
    EXPECT_EQ(counts.ranked(1), (std::vector<IdCount>{{3, 2}, {7, 2}, {2, 1}, {9, 1}}));
    EXPECT_EQ(counts.deepest(), 4u);
    counts.add(0, kNoId, 5);
    EXPECT_EQ(counts.ranked(0), (std::vector<IdCount>{{kNoId, 5}}));
}

// Values of the reference implementation of MurmurHash3_x86_32.
TEST(Cryptomatte, HashesAreMurmurs) {
    EXPECT_EQ(murmurHash3(""), 0u);
    EXPECT_EQ(murmurHash3("hello"), 0x248bfa47u);
    EXPECT_EQ(murmurHash3("hello, world"), 0x149bbb7fu);
    EXPECT_EQ(murmurHash3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

TEST(Cryptomatte, IdsAreNormalNumbers) {
    for (uint32_t i = 0; i < 20000; ++i)
        EXPECT_TRUE(std::isnormal(cryptomatteId("object " + std::to_string(i)))) << i;
    EXPECT_EQ(std::bit_cast<uint32_t>(cryptomatteId("hello")), 0x248bfa47u);
}

TEST(Cryptomatte, EqualNamesAreToldApart) {
    EXPECT_EQ(uniqueNames({"a", "b", "a", "a #2", "a"}),
              (std::vector<std::string>{"a", "b", "a #3", "a #2", "a #4"}));
}

// Read as the specification says: of each rank the id, then the share of samples.
TEST(Cryptomatte, ChannelsHoldIdsAndSharesByRank) {
    IdCounts counts(1);
    counts.add(0, 2, 5);
    counts.add(0, 1, 2);
    counts.add(0, kNoId, 1);
    const Cryptomatte matte = makeCryptomatte("CryptoObject", counts, {"ball", "box"}, {8});
    ASSERT_EQ(matte.channels.size(), 12u);
    const auto at = [&](const std::string& name) {
        for (const OwnedChannel<float>& channel : matte.channels)
            if (channel.name == name)
                return channel.values.front();
        return -1.0f;
    };
    EXPECT_EQ(at("CryptoObject00.R"), cryptomatteId("box"));
    EXPECT_EQ(at("CryptoObject00.G"), 0.625f);
    EXPECT_EQ(at("CryptoObject00.B"), cryptomatteId("ball"));
    EXPECT_EQ(at("CryptoObject00.A"), 0.25f);
    EXPECT_EQ(at("CryptoObject01.R"), 0.0f);
    EXPECT_EQ(at("CryptoObject02.A"), 0.0f);
    const std::string key = "cryptomatte/3ae39a5/"; // the first digits of the layer's hash
    EXPECT_EQ(matte.attributes.front(), (std::pair<std::string, std::string>{key + "name", "CryptoObject"}));
    EXPECT_EQ(matte.attributes.back().first, key + "manifest");
    EXPECT_NE(matte.attributes.back().second.find("\"box\":\""), std::string::npos);
}

TEST(Cryptomatte, AsManyRanksAreWrittenAsThePixelsHave) {
    IdCounts counts(1);
    std::vector<std::string> names;
    for (uint32_t id = 1; id <= 9; ++id) {
        counts.add(0, id, 10 - id);
        names.push_back(std::to_string(id));
    }
    const Cryptomatte matte = makeCryptomatte("CryptoObject", counts, names, {45});
    ASSERT_EQ(matte.channels.size(), 20u);
    EXPECT_EQ(matte.channels[16].name, "CryptoObject04.R");
    EXPECT_EQ(matte.channels[16].values.front(), cryptomatteId("9"));
}

} // namespace
} // namespace lavalight
