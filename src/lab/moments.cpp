#include "lab/moments.h"

namespace lavalight {

Moments merged(const Moments& a, const Moments& b) {
    const uint64_t count = a.count + b.count;
    if (count == 0)
        return {};
    const double shareOfB = static_cast<double>(b.count) / static_cast<double>(count);
    const double difference = b.mean - a.mean;
    const double between = difference * difference * static_cast<double>(a.count) * shareOfB;
    return {a.mean + difference * shareOfB, a.squares + b.squares + between, count};
}

Moments merged(std::span<const Moments> parts) {
    Moments all;
    for (const Moments& part : parts)
        all = merged(all, part);
    return all;
}

Moments momentsOf(std::span<const double> values) {
    Moments all;
    for (const double value : values)
        all = merged(all, Moments{value, 0.0, 1});
    return all;
}

} // namespace lavalight
