#include "render/setting_table.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <type_traits>
#include <utility>

#include "render/settings.h"

namespace lavalight {
namespace {

using Name = SettingName<uint32_t>;

template <typename Value>
constexpr Name named(std::string_view name, Value value) {
    return {name, static_cast<uint32_t>(value)};
}

constexpr std::array kOnOff{named("on", true), named("off", false)};
constexpr std::array kOffOn{named("off", false), named("on", true)};
constexpr std::array kSamplers{named("sobol", Sampler::sobol), named("independent", Sampler::independent)};
constexpr std::array kHemispheres{named("cosine", Hemisphere::cosine), named("uniform", Hemisphere::uniform)};
constexpr std::array kLightSelections{
    named("auto", LightSelection::automatic), named("power", LightSelection::power),
    named("uniform", LightSelection::uniform), named("tree", LightSelection::tree)};
constexpr std::array kMisKinds{named("power", Mis::power), named("balance", Mis::balance),
                               named("off", Mis::off)};
constexpr std::array kRoulettes{named("cbrt-throughput", Roulette::cbrtThroughput),
                                named("sqrt-throughput", Roulette::sqrtThroughput),
                                named("throughput", Roulette::throughput),
                                named("off", Roulette::off),
                                named("constant", Roulette::constant),
                                named("mean-albedo", Roulette::meanAlbedo),
                                named("max-albedo", Roulette::maxAlbedo)};
constexpr std::array kFresnels{named("exact", Fresnel::exact), named("schlick", Fresnel::schlick)};
constexpr std::array kTextureFilters{named("bilinear", TextureFilter::bilinear),
                                     named("stochastic", TextureFilter::stochastic)};

constexpr std::array kPixelFilters{
    named("box", PixelFilter::box),           named("tent", PixelFilter::tent),
    named("gaussian", PixelFilter::gaussian), named("blackman-harris", PixelFilter::blackmanHarris),
    named("mitchell", PixelFilter::mitchell), named("point", PixelFilter::point)};

template <auto member>
constexpr NamedValues oneOf(std::span<const Name> names, std::optional<uint32_t> constant) {
    using Value = std::remove_reference_t<decltype(std::declval<EstimatorSettings&>().*member)>;
    return {names, [](const EstimatorSettings& s) { return static_cast<uint32_t>(s.*member); },
            [](EstimatorSettings& s, uint32_t value) { s.*member = static_cast<Value>(value); }, constant,
            std::is_same_v<Value, bool>};
}

using E = EstimatorSettings;

// Whether the roulette's probability does not depend on the direction that is drawn next.
constexpr bool isKnownBeforeSampling(Roulette roulette) {
    return roulette == Roulette::constant || roulette == Roulette::meanAlbedo ||
           roulette == Roulette::maxAlbedo;
}

constexpr std::array kRows{
    SettingRow{.name = "sampler",
               .values = oneOf<&E::sampler>(kSamplers, CONSTANT_SAMPLER),
               .decidesBits = true,
               .mayChangeMean = false,
               .help = "Which random numbers samples use: Owen-scrambled Sobol points, or independent ones",
               .panelLabel = "sampler",
               .panelHelp = "Where samples lie: Sobol's points fill each square evenly, independent ones "
                            "clump. Watch the noise of soft shadows"},
    SettingRow{.name = "hemisphere",
               .values = oneOf<&E::hemisphere>(kHemispheres, CONSTANT_HEMISPHERE),
               .decidesBits = true,
               .mayChangeMean = false,
               .help = "How diffuse surfaces draw directions: by the cosine, or uniformly",
               .panelLabel = "hemisphere",
               .panelHelp = "Directions of diffuse surfaces. By the cosine: those that count more come more "
                            "often, and each path has the same weight"},
    SettingRow{.name = "nee",
               .values = oneOf<&E::nextEventEstimation>(kOnOff, CONSTANT_NEE),
               .decidesBits = true,
               .mayChangeMean = false,
               .help = "Next-event estimation; off: light is found only by hitting it, and lights without "
                       "size are not found, which enters the bias ledger",
               .panelLabel = "next-event estimation",
               .panelHelp = "Every vertex asks a light whether it is seen. Off: paths find light only by "
                            "running into it, and small lights become noise"},
    SettingRow{.name = "light-selection",
               .values = oneOf<&E::lightSelection>(kLightSelections, std::nullopt),
               .decidesBits = true,
               .mayChangeMean = false,
               .help = "Which light NEE picks: by power, all alike, or by what each may bring to the point "
                       "(auto: by that where there are several lights, else by power)",
               .panelLabel = "light selection",
               .panelHelp = "Which light is asked: by its power, all alike, or by what it may bring to this "
                            "very point (a tree of lights)"},
    SettingRow{.name = "mis",
               .values = oneOf<&E::mis>(kMisKinds, CONSTANT_MIS),
               .decidesBits = true,
               .mayChangeMean = false,
               .help = "Weights of light and BSDF samples: Veach's heuristics; off: only the sampled light "
                       "counts where both could find it",
               .panelLabel = "MIS",
               .panelHelp = "A light found both by asking and by running into it is weighted by how likely "
                            "each was. Off: only one of the two counts, and mirrors of lamps get fireflies"},
    SettingRow{.name = "roulette",
               .values = oneOf<&E::roulette>(kRoulettes, CONSTANT_ROULETTE),
               .decidesBits = true,
               .mayChangeMean = false,
               .help = "Probability that a path goes on: by the light it carries (its cube root, which "
                       "spares paths from smooth mirrors and glass, its square root, or itself), by albedo, "
                       "constant, or 1 (off)",
               .panelLabel = "roulette",
               .panelHelp = "A path that carries little is ended by chance; one that survives counts for "
                            "those that did not. The mean stays"},
    SettingRow{.name = "roulette-start",
               .values = WholeNumber{&E::rouletteStart, 1, 0x7fffffff, 64},
               .decidesBits = true,
               .mayChangeMean = false,
               .help = "First vertex where a path may die (the camera's first hit is vertex 1)",
               .panelLabel = "from vertex",
               .panelHelp =
                   "The first vertex where a path may end so; what the camera sees first is vertex 1"},
    SettingRow{.name = "roulette-probability",
               .values = PositiveNumber{&E::rouletteProbability, 1.0f, 0.05f, 1.0f},
               .decidesBits = true,
               .mayChangeMean = false,
               .help = "Survival probability of --roulette constant",
               .panelLabel = "survival",
               .panelHelp = "The probability to go on, whatever the path carries",
               .applies = [](const E& s) { return s.roulette == Roulette::constant; }},
    SettingRow{.name = "mis-survival",
               .values = oneOf<&E::misSurvival>(kOffOn, CONSTANT_MIS_SURVIVAL),
               .decidesBits = true,
               .mayChangeMean = false,
               .help = "MIS weights count the probability of survival; needs a roulette of constant, "
                       "mean-albedo or max-albedo",
               .panelLabel = "MIS counts survival",
               .panelHelp = "The density of a direction in MIS weights is multiplied by the probability that "
                            "the path lives to take it",
               .applies = [](const E& s) { return isKnownBeforeSampling(s.roulette); }},
    SettingRow{.name = "fresnel",
               .values = oneOf<&E::fresnel>(kFresnels, CONSTANT_FRESNEL),
               .decidesBits = true,
               .mayChangeMean = true,
               .help = "Reflectance of glass: exact, or Schlick's approximation, which is another model",
               .panelLabel = "fresnel",
               .panelHelp = "How much glass reflects: exactly, or by Schlick's polynomial. They are two "
                            "models: the image itself changes a little"},
    SettingRow{.name = "multiple-scattering",
               .values = oneOf<&E::multipleScattering>(kOffOn, CONSTANT_MULTIPLE_SCATTERING),
               .decidesBits = true,
               .mayChangeMean = true,
               .help = "Rough metal returns what its facets send on to each other, which glTF's model loses",
               .panelLabel = "multiple scattering",
               .panelHelp =
                   "Rough metal returns what its facets send on to each other, which glTF's model loses"},
    SettingRow{.name = "texture-filter",
               .values = oneOf<&E::textureFilter>(kTextureFilters, CONSTANT_TEXTURE_FILTER),
               .decidesBits = true,
               .mayChangeMean = true,
               .help = "Textures between texels: bilinear, or one of the four texels, drawn by its share "
                       "(Pharr et al. 2024), which averages shading in place of texels",
               .panelLabel = "texture filter",
               .panelHelp = "Between texels: the mean of four, or one of the four by chance, which has that "
                            "mean"},
    SettingRow{.name = "smooth-terminator",
               .values = oneOf<&E::smoothTerminator>(kOnOff, CONSTANT_SMOOTH_TERMINATOR),
               .decidesBits = true,
               .mayChangeMean = true,
               .help = "Smooth-shaded meshes are lit as the smooth surface that their normals stand for "
                       "(Hanika 2021); off: their triangles cast shadows on themselves",
               .panelLabel = "smooth terminator",
               .panelHelp = "Where the smooth surface turns away from a light, shading fades. Off: coarse "
                            "triangles turn away one by one, in stairs, and mirrors have black rims"},
    SettingRow{.name = "max-bounces",
               .values = WholeNumber{&E::maxBounces, 0, kMaxBounceLimit, 256},
               .decidesBits = true,
               .mayChangeMean = true,
               .help = "Scattering vertices of a path; 0: emission only, 1: direct light. Paths that it cuts "
                       "enter the bias ledger",
               .panelLabel = "bounces at most",
               .panelHelp =
                   "Scattering vertices of a path. 0 shows lamps alone, 1 direct light; a limit that "
                   "is reached takes light away"},
    SettingRow{.name = "clamp-indirect",
               .values = PositiveNumber{&E::clampIndirect, std::numeric_limits<float>::infinity(), 0.01f,
                                        1000.0f, "off", 10.0f},
               .decidesBits = true,
               .mayChangeMean = true,
               .help = "Largest indirect contribution; biased, enters the bias ledger",
               .panelLabel = "clamp indirect light",
               .panelHelp = "Takes the tops off fireflies, and light with them: the image is biased. The "
                            "limit is for the largest channel of what comes from beyond the first vertex"},
    SettingRow{
        .name = "filter",
        .values = oneOf<&E::pixelFilter>(kPixelFilters, std::nullopt),
        .decidesBits = true,
        .mayChangeMean = true,
        .help =
            "Pixel filter: how a pixel weighs the light around its middle. Samples are drawn by it, so that "
            "pixels stay independent; mitchell has negative lobes, which sharpen; point sees the middle "
            "alone",
        .panelLabel = "pixel filter",
        .panelHelp = "How a pixel weighs the light around its middle: wider filters are smoother, and edges "
                     "have fewer stairs"},
    SettingRow{
        .name = "filter-radius",
        .values =
            PositiveNumber{&E::filterRadius, std::numeric_limits<float>::infinity(), 0.1f, 4.0f, "own", 1.0f},
        .decidesBits = true,
        .mayChangeMean = true,
        .help = "Pixels from the middle to where the filter ends; own: 0.5 of box, 1 of tent, 2 of mitchell, "
                "1.5 of the others; always 0 of point",
        .panelLabel = "filter radius",
        .panelHelp = "Pixels from the middle to where the filter ends",
        .applies = [](const E& s) { return s.pixelFilter != PixelFilter::point; }},
    SettingRow{.name = "seed",
               .values = WholeNumber{&E::seed, 0, std::numeric_limits<uint32_t>::max(), 1'000'000},
               .decidesBits = true,
               .mayChangeMean = false,
               .help = "Another seed gives other noise",
               .panelLabel = "seed",
               .panelHelp = "Another seed gives other noise with the same mean"},
};

// Every member has a row.
struct Anything {
    template <typename Member>
    constexpr operator Member() const;
};

template <typename Struct, typename... Members>
consteval size_t memberCount() {
    if constexpr (requires { Struct{Members{}..., Anything{}}; })
        return memberCount<Struct, Members..., Anything>();
    else
        return sizeof...(Members);
}

constexpr bool isSame(const SettingRow& row, const E& a, const E& b) {
    if (const auto* values = std::get_if<NamedValues>(&row.values))
        return values->get(a) == values->get(b);
    if (const auto* number = std::get_if<WholeNumber>(&row.values))
        return a.*number->member == b.*number->member;
    const float E::*const member = std::get<PositiveNumber>(row.values).member;
    return a.*member == b.*member;
}

constexpr void setAnother(const SettingRow& row, E& settings) {
    if (const auto* values = std::get_if<NamedValues>(&row.values))
        values->set(settings, values->names.back().value);
    else if (const auto* number = std::get_if<WholeNumber>(&row.values))
        ++(settings.*number->member);
    else
        settings.*std::get<PositiveNumber>(row.values).member = 0.25f;
}

// No two rows share a member: what one sets, the others do not see.
consteval bool rowsAreIndependent() {
    for (const SettingRow& row : kRows) {
        E settings;
        setAnother(row, settings);
        for (const SettingRow& other : kRows)
            if (isSame(other, settings, E{}) == (&other == &row))
                return false;
    }
    return true;
}

static_assert(memberCount<E>() == kRows.size(), "each member of EstimatorSettings needs a row in kRows");
static_assert(rowsAreIndependent(), "each row of kRows needs a member of EstimatorSettings of its own");

} // namespace

std::span<const SettingRow> settingRows() {
    return kRows;
}

const SettingRow& rowOf(std::string_view name) {
    const auto found =
        std::find_if(kRows.begin(), kRows.end(), [&](const SettingRow& row) { return row.name == name; });
    assert(found != kRows.end());
    return *found;
}

bool haveSameValue(const SettingRow& row, const EstimatorSettings& a, const EstimatorSettings& b) {
    return isSame(row, a, b);
}

} // namespace lavalight
