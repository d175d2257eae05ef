#include "film/cryptomatte.h"

#include <algorithm>
#include <array>
#include <bit>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lavalight {
namespace {

constexpr size_t kFewestRanks = 6;  // three layers, which programs expect
constexpr size_t kMostRanks = 20;   // ten layers, whose numbers have two digits
constexpr size_t kRanksOfLayer = 2; // R, G: id and share of the first; B, A: of the second

uint32_t mixed(uint32_t k) {
    k *= 0xcc9e2d51u;
    k = std::rotl(k, 15);
    return k * 0x1b873593u;
}

uint32_t bytesFrom(std::string_view text, size_t first, size_t count) {
    uint32_t word = 0;
    for (size_t i = 0; i < count; ++i)
        word |= uint32_t{static_cast<unsigned char>(text[first + i])} << (8 * i);
    return word;
}

// Hashes whose bits are those of a float that is denormal, infinite or NaN get another exponent.
uint32_t asNormalFloat(uint32_t hash) {
    const uint32_t exponent = hash >> 23 & 0xffu;
    return exponent == 0 || exponent == 0xff ? hash ^ 1u << 23 : hash;
}

nlohmann::ordered_json manifestOf(const std::vector<std::string>& names) {
    nlohmann::ordered_json manifest = nlohmann::ordered_json::object();
    for (const std::string& name : names)
        manifest[name] = fmt::format("{:08x}", asNormalFloat(murmurHash3(name)));
    return manifest;
}

} // namespace

uint32_t murmurHash3(std::string_view text) {
    uint32_t hash = 0;
    const size_t blocks = text.size() / 4;
    for (size_t i = 0; i < blocks; ++i) {
        hash ^= mixed(bytesFrom(text, 4 * i, 4));
        hash = std::rotl(hash, 13) * 5 + 0xe6546b64u;
    }
    hash ^= mixed(bytesFrom(text, 4 * blocks, text.size() % 4));
    hash ^= static_cast<uint32_t>(text.size());
    hash ^= hash >> 16;
    hash *= 0x85ebca6bu;
    hash ^= hash >> 13;
    hash *= 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

float cryptomatteId(std::string_view name) {
    return std::bit_cast<float>(asNormalFloat(murmurHash3(name)));
}

std::vector<std::string> uniqueNames(const std::vector<std::string>& names) {
    std::set<std::string> taken(names.begin(), names.end());
    std::set<std::string> used;
    std::vector<std::string> unique;
    for (const std::string& name : names) {
        std::string own = name;
        for (int number = 2; (own != name && taken.contains(own)) || !used.insert(own).second; ++number)
            own = fmt::format("{} #{}", name, number);
        unique.push_back(own);
    }
    return unique;
}

Cryptomatte makeCryptomatte(const std::string& layer, const IdCounts& counts,
                            const std::vector<std::string>& names, const std::vector<uint32_t>& samples) {
    const std::vector<std::string> unique = uniqueNames(names);
    std::vector<float> ids;
    ids.reserve(unique.size());
    for (const std::string& name : unique)
        ids.push_back(cryptomatteId(name));
    size_t ranks = std::clamp(counts.deepest(), kFewestRanks, kMostRanks);
    ranks += ranks % kRanksOfLayer;
    Cryptomatte matte;
    for (size_t rank = 0; rank < ranks; ++rank)
        for (const char* channel : rank % kRanksOfLayer == 0 ? std::array{"R", "G"} : std::array{"B", "A"})
            matte.channels.push_back({fmt::format("{}{:02}.{}", layer, rank / kRanksOfLayer, channel),
                                      std::vector<float>(counts.pixels())});
    for (size_t pixel = 0; pixel < counts.pixels(); ++pixel) {
        size_t rank = 0;
        for (const IdCount& counted : counts.ranked(pixel)) {
            if (counted.id == kNoId || counted.id > ids.size() || rank == ranks)
                continue;
            matte.channels[2 * rank].values[pixel] = ids[counted.id - 1];
            matte.channels[2 * rank + 1].values[pixel] =
                static_cast<float>(counted.count) / static_cast<float>(samples[pixel]);
            ++rank;
        }
    }
    const std::string key =
        fmt::format("{}{:.7}/", kCryptomatteAttribute, fmt::format("{:08x}", murmurHash3(layer)));
    matte.attributes = {{key + "name", layer},
                        {key + "hash", "MurmurHash3_32"},
                        {key + "conversion", "uint32_to_float32"},
                        {key + "manifest",
                         manifestOf(unique).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)}};
    return matte;
}

} // namespace lavalight
