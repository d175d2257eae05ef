#include "film/id_counts.h"

#include <algorithm>

namespace lavalight {

void IdCounts::add(size_t pixel, uint32_t id, uint32_t count) {
    IdCount& first = first_[pixel];
    if (first.count == 0)
        first.id = id;
    if (first.id == id) {
        first.count += count;
        return;
    }
    std::vector<IdCount>& others = further_[pixel];
    const auto known =
        std::find_if(others.begin(), others.end(), [&](const IdCount& other) { return other.id == id; });
    if (known == others.end())
        others.push_back({id, count});
    else
        known->count += count;
}

std::vector<IdCount> IdCounts::ranked(size_t pixel) const {
    std::vector<IdCount> all;
    if (first_[pixel].count > 0)
        all.push_back(first_[pixel]);
    if (const auto others = further_.find(pixel); others != further_.end())
        all.insert(all.end(), others->second.begin(), others->second.end());
    std::sort(all.begin(), all.end(), [](const IdCount& a, const IdCount& b) {
        return a.count != b.count ? a.count > b.count : a.id < b.id;
    });
    return all;
}

size_t IdCounts::deepest() const {
    size_t deepest =
        std::any_of(first_.begin(), first_.end(), [](const IdCount& c) { return c.count > 0; }) ? 1 : 0;
    for (const auto& [pixel, others] : further_)
        deepest = std::max(deepest, 1 + others.size());
    return deepest;
}

} // namespace lavalight
