#include "cli/options/render_options.h"

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/options/named_option.h"
#include "cli/options/option_values.h"
#include "film/sample_ranges.h"
#include "render/presets.h"
#include "render/setting_names.h"

namespace lavalight {
namespace {

void parseSize(const std::string& text, RenderSettings& settings) {
    const auto parts = splitAt(text, 'x');
    const auto width = parts.size() == 2 ? parseNumber<uint32_t>(parts[0]) : std::nullopt;
    const auto height = parts.size() == 2 ? parseNumber<uint32_t>(parts[1]) : std::nullopt;
    if (!width || !height || *width < 1 || *width > kMaxImageSide || *height < 1 || *height > kMaxImageSide)
        throw UsageError(fmt::format("--size: \"{}\" is not WIDTHxHEIGHT with sides of 1 to {} pixels", text,
                                     kMaxImageSide));
    settings.image.width = *width;
    settings.image.height = *height;
}

void addSwitch(CLI::App& parser, const std::string& option, bool& value, const std::string& help) {
    const std::map<std::string, bool> values{{"on", true}, {"off", false}};
    parser.add_option(option, value, help)
        ->type_name("on|off")
        ->transform(oneOf(values))
        ->default_str(value ? "on" : "off");
}

float parseClamp(const std::string& text) {
    if (text == "off")
        return std::numeric_limits<float>::infinity();
    const auto value = parseNumber<float>(text);
    if (!value || !(*value > 0.0f))
        throw UsageError(fmt::format("--clamp-indirect: \"{}\" is neither off nor a radiance above 0", text));
    return *value;
}

} // namespace

RenderOptions::RenderOptions(CLI::App& parser) : parser_(&parser), camera_(parser), environment_(parser) {
    declareImage(parser);
    declareStop(parser);
    declareEstimator(parser);
    declareRoulette(parser);
    declareDevice(parser);
}

void RenderOptions::declareImage(CLI::App& parser) {
    parser.add_option("--size", size_, "Image size in pixels; default: 512 high, as wide as the camera asks")
        ->type_name("WxH");
    parser.add_option("--seed", estimator_.seed, "Another seed, other noise")->type_name("N");
}

void RenderOptions::declareStop(CLI::App& parser) {
    parser
        .add_option("--spp", settings_.stop.samples,
                    "Samples per pixel; no limit with --time or --target-error")
        ->type_name("N");
    parser
        .add_option("--samples", samples_,
                    "Instead of --spp: samples A to before B of each pixel; the EXR can be joined with those "
                    "of other ranges (see lavalight merge)")
        ->type_name("A:B");
    parser.add_option("--time", settings_.stop.seconds, "Stop after this time")->type_name("SECONDS");
    parser
        .add_option("--target-error", settings_.stop.targetError,
                    "Stop at this estimated relMSE; enters the bias ledger")
        ->type_name("RELMSE");
}

void RenderOptions::declareEstimator(CLI::App& parser) {
    EstimatorSettings& e = estimator_;
    parser
        .add_option("--preset", preset_,
                    "Settings by name (see lavalight presets); other options change them")
        ->type_name("NAME");
    addNamed(parser, "--sampler", e.sampler, "Sample numbers: Owen-scrambled Sobol, or independent");
    addNamed(parser, "--hemisphere", e.hemisphere,
             "Directions of diffuse surfaces: by the cosine, or all alike");
    addSwitch(parser, "--nee", e.nextEventEstimation,
              "Next-event estimation; off: light is found only by hitting it");
    addNamed(parser, "--light-selection", e.lightSelection,
             "Which light NEE picks: by power, all alike, or by what each brings to the point (auto: where "
             "there are several)");
    addNamed(parser, "--mis", e.mis, "Weights of light and BSDF samples");
    addSwitch(parser, "--mis-survival", e.misSurvival, "MIS weights count the probability of survival");
    addNamed(parser, "--fresnel", e.fresnel, "Reflectance of glass: exact, or Schlick's approximation");
    addSwitch(parser, "--multiple-scattering", e.multipleScattering,
              "Rough metal returns what its facets send on to each other, which glTF's model loses");
    addNamed(parser, "--texture-filter", e.textureFilter,
             "Textures between texels: bilinear, or one of the four texels, drawn by its share");
    parser
        .add_option("--max-bounces", e.maxBounces,
                    "Scattering vertices of a path; 0: emission only, 1: direct light")
        ->type_name("N");
    parser
        .add_option("--clamp-indirect", clampIndirect_,
                    "Largest indirect contribution; biased, enters the ledger")
        ->type_name("off|X");
}

void RenderOptions::declareRoulette(CLI::App& parser) {
    EstimatorSettings& e = estimator_;
    addNamed(parser, "--roulette", e.roulette, "What decides whether a path goes on");
    parser
        .add_option("--roulette-start", e.rouletteStart, "First vertex where a path may die (first hit: 1)")
        ->type_name("N");
    parser
        .add_option("--roulette-probability", e.rouletteProbability,
                    "Survival probability of --roulette constant")
        ->type_name("P");
}

void RenderOptions::declareDevice(CLI::App& parser) {
    device_.emplace(parser);
    addNamed(parser, "--schedule,--kernels", settings_.work.schedule,
             "One kernel for whole paths, or one for each step; auto: by device");
    parser
        .add_option("--wave-size", settings_.work.waveSize,
                    "Paths in flight; 0: by the kernels; changes no bit of the image")
        ->type_name("N");
    parser
        .add_option("--band-rows", settings_.work.bandRows,
                    "Rows of a film band; 0: as many as fit; changes no bit of the image")
        ->type_name("N");
}

RenderSettings RenderOptions::settings() const {
    RenderSettings settings = settings_;
    settings.estimator = preset_.empty() ? EstimatorSettings{} : findPreset(preset_).settings;
    // An option that was given wins over the preset.
    const auto take = [&](const char* option, auto member) {
        if (parser_->count(option) > 0)
            settings.estimator.*member = estimator_.*member;
    };
    take("--sampler", &EstimatorSettings::sampler);
    take("--hemisphere", &EstimatorSettings::hemisphere);
    take("--nee", &EstimatorSettings::nextEventEstimation);
    take("--light-selection", &EstimatorSettings::lightSelection);
    take("--mis", &EstimatorSettings::mis);
    take("--mis-survival", &EstimatorSettings::misSurvival);
    take("--fresnel", &EstimatorSettings::fresnel);
    take("--multiple-scattering", &EstimatorSettings::multipleScattering);
    take("--texture-filter", &EstimatorSettings::textureFilter);
    take("--max-bounces", &EstimatorSettings::maxBounces);
    take("--roulette", &EstimatorSettings::roulette);
    take("--roulette-start", &EstimatorSettings::rouletteStart);
    take("--roulette-probability", &EstimatorSettings::rouletteProbability);
    take("--seed", &EstimatorSettings::seed);
    settings.estimator.clampIndirect = parseClamp(clampIndirect_);
    if (!samples_.empty())
        takeRange(settings);
    const bool stopsEarly = settings.stop.seconds > 0.0 || settings.stop.targetError > 0.0;
    if (stopsEarly && parser_->count("--spp") == 0)
        settings.stop.samples = 0x7fffffff;
    if (!size_.empty())
        parseSize(size_, settings);
    settings.lighting = environment_.lighting();
    settings.provenance.cameraOptions = describe(camera_.choice());
    return settings;
}

void RenderOptions::takeRange(RenderSettings& settings) const {
    const std::optional<SampleRanges> ranges = parseSampleRanges(samples_);
    if (!ranges || ranges->size() != 1)
        throw UsageError(fmt::format("--samples: \"{}\" is not A:B with A below B", samples_));
    for (const char* option : {"--spp", "--time", "--target-error"})
        if (parser_->count(option) > 0)
            throw UsageError(
                fmt::format("--samples and {}: samples A to before B are exactly those, whatever "
                            "time or error they come to; give one of the two",
                            option));
    settings.image.firstSample = ranges->front().first;
    settings.stop.samples = countOf(*ranges);
}

RenderPlan RenderOptions::plan(const std::string& scene) const {
    return {scene, settings(), camera_.choice(), device(), {}};
}

gpu::DeviceConfig RenderOptions::device() const {
    return device_->config();
}

} // namespace lavalight
