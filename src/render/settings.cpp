#include "render/settings.h"

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {
namespace {

void requireRange(const char* option, uint64_t value, uint64_t least, uint64_t most) {
    if (value < least || value > most)
        throw UsageError(fmt::format("{}: {} is outside the range {} to {}", option, value, least, most));
}

} // namespace

void checkSettings(const RenderSettings& settings) {
    requireRange("--size (width)", settings.width, 1, kMaxImageSide);
    requireRange("--size (height)", settings.height, 1, kMaxImageSide);
    requireRange("--spp", settings.samples, 1, 0x7fffffffu);
    requireRange("--wave-size", settings.waveSize, 64, 4000000);
    requireRange("--max-bounces", settings.estimator.maxBounces, 0, kMaxBounceLimit);
    requireRange("--roulette-start", settings.estimator.rouletteStart, 1, 0x7fffffffu);
}

std::string_view nameOf(Mis value) {
    switch (value) {
    case Mis::power:
        return "power";
    case Mis::balance:
        return "balance";
    case Mis::off:
        return "off";
    }
    return "";
}

std::string_view nameOf(Roulette value) {
    return value == Roulette::throughput ? "throughput" : "off";
}

std::vector<std::pair<std::string, std::string>> describe(const RenderSettings& settings) {
    const EstimatorSettings& e = settings.estimator;
    std::vector<std::pair<std::string, std::string>> pairs{
        {"size", fmt::format("{}x{}", settings.width, settings.height)},
        {"spp", fmt::format("{}", settings.samples)},
        {"first-sample", fmt::format("{}", settings.firstSample)},
        {"seed", fmt::format("{}", e.seed)},
        {"nee", e.nextEventEstimation ? "on" : "off"},
        {"mis", std::string(nameOf(e.mis))},
        {"roulette", std::string(nameOf(e.roulette))},
        {"roulette-start", fmt::format("{}", e.rouletteStart)},
        {"max-bounces", fmt::format("{}", e.maxBounces)},
    };
    if (settings.environment)
        pairs.emplace_back("env", fmt::format("{},{},{}", settings.environment->x, settings.environment->y,
                                              settings.environment->z));
    return pairs;
}

} // namespace lavalight
