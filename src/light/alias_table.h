// Picking from a list with given probabilities in constant time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lavalight {

// One bin, laid out for kernels. With a 32-bit random r, the pick among n bins is
//     product = uint64(r) * n;   bin = product >> 32;   u = (low 32 bits of product >> 8) * 2^-24
//     pick = u < entry[bin].probability ? bin : entry[bin].alias
// and entry[pick].pmf is its probability.
struct AliasEntry {
    // Probability of staying in this bin: a multiple of 2^-24, so that it is exactly how often u is below.
    float probability = 0.0f;
    uint32_t alias = 0;
    float pmf = 0.0f; // probability of this entry being picked
};
static_assert(sizeof(AliasEntry) == 12);

// One entry per weight; empty when no weight is positive. An entry of weight 0 is never picked, one of
// positive weight always can be. pmf is what the table does, not what was asked for: the two differ by at
// most 2^-24 (1 + donors) / n, donors being the bins that alias to the entry; the sum of all differences is
// below 2^-23. What the finite number of values of r adds, (1 + donors) / 2^32 at most, is not in pmf. Throws
// Error for negative or infinite weights or sums, or more than 2^24 weights.
[[nodiscard]] std::vector<AliasEntry> buildAliasTable(std::span<const double> weights);

} // namespace lavalight
