// The line of a header that is the bias ledger comes back as its entries.
#include <gtest/gtest.h>

#include "film/bias_ledger.h"

namespace lavalight {
namespace {

void expectBack(const std::vector<LedgerEntry>& ledger) {
    const std::vector<LedgerEntry> back = parseLedger(ledgerText(ledger));
    ASSERT_EQ(back.size(), ledger.size()) << ledgerText(ledger);
    for (size_t i = 0; i < ledger.size(); ++i) {
        EXPECT_EQ(back[i].cause, ledger[i].cause);
        EXPECT_EQ(back[i].detail, ledger[i].detail);
    }
}

TEST(BiasLedger, EntriesComeBack) {
    expectBack({});
    expectBack({{"cut-paths", "6 paths, mean throughput 0.5"}});
    expectBack({{"clamp-indirect", "5"},
                {"cut-paths", "6 paths: many"},
                {"denoised", "by Open Image Denoise 2.3, high"}});
}

TEST(BiasLedger, SemicolonsOfADetailEndNoEntry) {
    expectBack({{"unread", "texture \"a; b\"; and 3 more"}, {"cut-paths", "6"}});
}

} // namespace
} // namespace lavalight
