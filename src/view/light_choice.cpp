#include "view/light_choice.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/option_text.h"
#include "render/setting_names.h"

namespace lavalight {

bool isSameLight(const LightingSettings& a, const LightingSettings& b) {
    return a.constant == b.constant && a.mapFile == b.mapFile && a.procedural == b.procedural &&
           (a.procedural != ProceduralEnvironment::sky || a.sky == b.sky);
}

void takeLight(const LightingSettings& light, LightingSettings& settings) {
    const auto [rotation, intensity] = std::pair(settings.rotation, settings.intensity);
    settings = light;
    settings.rotation = rotation;
    settings.intensity = intensity;
}

std::vector<LightOffer> lightOffers(const LightingSettings& now, const std::string& map) {
    LightingSettings studio;
    studio.procedural = ProceduralEnvironment::studio;
    LightingSettings sky;
    sky.procedural = ProceduralEnvironment::sky;
    sky.sky = now.sky;
    LightingSettings white;
    white.constant = glm::vec3(1.0f);
    std::vector<LightOffer> offers{{"the file's own", {}},
                                   {std::string(nameOf(studio.procedural)), studio},
                                   {std::string(nameOf(sky.procedural)), sky},
                                   {"white", white}};
    if (!map.empty()) {
        LightingSettings mapped;
        mapped.mapFile = map;
        offers.push_back({std::filesystem::path(map).filename().string(), mapped});
    }
    const bool isOffered = std::any_of(offers.begin(), offers.end(), [&](const LightOffer& offer) {
        return isSameLight(offer.lighting, now);
    });
    if (!isOffered && now.constant) {
        LightingSettings constant;
        constant.constant = now.constant;
        offers.push_back({commaText(*now.constant), constant});
    }
    return offers;
}

} // namespace lavalight
