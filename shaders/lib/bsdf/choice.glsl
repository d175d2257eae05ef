// Which lobe a direction is drawn from: lobes are chosen by their shares of the directional albedo.
#include "lib/bsdf/layers.glsl"

struct LobeProbabilities {
    float diffuse;
    float through;
    float specular;
    float sheen;
    float glass;
    float clearcoat;
};

LobeProbabilities lobeProbabilities(Surface s, vec3 wo) {
    const LobeAlbedos a = lobeAlbedos(s, wo);
    const LobeProbabilities share = LobeProbabilities(meanOf(a.diffuse), meanOf(a.through), meanOf(a.specular),
                                                      meanOf(a.sheen), a.glass, a.clearcoat);
    const float sum = share.diffuse + share.through + share.specular + share.sheen + share.glass + share.clearcoat;
    const float scale = 1.0 / max(sum, 1e-20);
    return LobeProbabilities(scale * share.diffuse, scale * share.through, scale * share.specular,
                             scale * share.sheen, scale * share.glass, scale * share.clearcoat);
}

const uint kLobeDiffuse = 0u;
const uint kLobeThrough = 1u;
const uint kLobeSpecular = 2u;
const uint kLobeSheen = 3u;
const uint kLobeGlass = 4u;
const uint kLobeClearcoat = 5u;

struct LobeChoice {
    uint lobe;
    float probability;
    float rest; // what is left of the random number: uniform in [0, 1) again
};

LobeChoice chooseLobe(LobeProbabilities p, float u) {
    if (sceneHas(kFeatureGlass) && u < p.glass)
        return LobeChoice(kLobeGlass, p.glass, u / p.glass);
    u -= p.glass;
    if (sceneHas(kFeatureSpecular) && u < p.specular)
        return LobeChoice(kLobeSpecular, p.specular, u / p.specular);
    u -= p.specular;
    if (sceneHas(kFeatureClearcoat) && u < p.clearcoat)
        return LobeChoice(kLobeClearcoat, p.clearcoat, u / p.clearcoat);
    u -= p.clearcoat;
    if (sceneHas(kFeatureSheen) && u < p.sheen)
        return LobeChoice(kLobeSheen, p.sheen, u / p.sheen);
    u -= p.sheen;
    if (sceneHas(kFeatureDiffuseTransmission) && u < p.through)
        return LobeChoice(kLobeThrough, p.through, u / p.through);
    return LobeChoice(kLobeDiffuse, p.diffuse, 0.0);
}
