#include "cli/options/render_options.h"

#include <optional>
#include <span>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/options/named_option.h"
#include "cli/options/option_values.h"
#include "film/sample_ranges.h"
#include "render/presets.h"
#include "render/setting_names.h"
#include "render/setting_text.h"

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

std::string optionOf(const SettingRow& row) {
    return fmt::format("--{}", row.name);
}

} // namespace

RenderOptions::RenderOptions(CLI::App& parser) : parser_(&parser), camera_(parser), environment_(parser) {
    declareImage(parser);
    declareStop(parser);
    declareEstimator(parser);
    declareDevice(parser);
}

void RenderOptions::declareImage(CLI::App& parser) {
    parser.add_option("--size", size_, "Image size in pixels; default: 512 high, as wide as the camera asks")
        ->type_name("WxH");
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
    parser
        .add_option("--preset", preset_,
                    "Settings by name (see lavalight presets); other options change them")
        ->type_name("NAME");
    const std::span<const SettingRow> rows = settingRows();
    estimator_.resize(rows.size());
    for (size_t i = 0; i < rows.size(); ++i)
        parser.add_option(optionOf(rows[i]), estimator_[i], std::string(rows[i].help))
            ->type_name(valueNames(rows[i]))
            ->default_str(textOf(rows[i], EstimatorSettings{}));
}

void RenderOptions::declareDevice(CLI::App& parser) {
    device_.emplace(parser);
    addNamed(parser, "--schedule", settings_.work.schedule,
             "One kernel for whole paths, one for each step, or rays traced by the host; auto: by device");
    addNamed(
        parser, "--accelerator", settings_.work.accelerator,
        "What finds the triangles that rays meet: bvh8, a tree that kernels traverse; bvh16 or embree, trees "
        "that the host traverses; or ray-query, the device's own units; auto: by schedule and device");
    // The earlier name of --schedule, left out of the help.
    addNamed(parser, "--kernels", settings_.work.schedule, "");
    parser.get_option("--kernels")->group("");
    parser
        .add_option("--wave-size", settings_.work.waveSize,
                    "Most paths in flight, by the schedule hosted 931919; 0: by the schedule; changes no bit "
                    "of the image")
        ->type_name("N");
    parser
        .add_option("--band-rows", settings_.work.bandRows,
                    "Rows of a film band; 0: as many as fit; changes no bit of the image")
        ->type_name("N");
}

RenderSettings RenderOptions::settings() const {
    if (parser_->count("--schedule") > 0 && parser_->count("--kernels") > 0)
        throw UsageError("--schedule and --kernels: these are one option; give one of the two");
    RenderSettings settings = settings_;
    settings.estimator = preset_.empty() ? EstimatorSettings{} : findPreset(preset_).settings;
    const std::span<const SettingRow> rows = settingRows();
    for (size_t i = 0; i < rows.size(); ++i)
        if (parser_->count(optionOf(rows[i])) > 0) // the option wins over the preset
            setText(rows[i], settings.estimator, estimator_[i]);
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
