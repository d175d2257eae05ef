#include "session/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/os/machine.h"
#include "base/version.h"
#include "film/film_cost.h"
#include "film/id_layers.h"
#include "render/phase.h"
#include "render/setting_names.h"

namespace lavalight {
namespace {

using Json = nlohmann::ordered_json;

double perSecond(uint64_t count, double seconds) {
    return seconds > 0.0 ? static_cast<double>(count) / seconds : 0.0;
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

// Options that were given and the settings, under the names of their options.
Pairs describeOptions(const RenderReport& report) {
    Pairs pairs = describe(report.settings);
    if (report.import.seconds)
        pairs.emplace_back("at", fmt::format("{}", *report.import.seconds));
    if (!report.import.animation.empty())
        pairs.emplace_back("animation", report.import.animation);
    if (!report.import.scene.empty())
        pairs.emplace_back("scene", report.import.scene);
    if (!report.import.variant.empty())
        pairs.emplace_back("variant", report.import.variant);
    return pairs;
}

Json pairsJson(const Pairs& pairs) {
    Json json = Json::object();
    for (const auto& [key, value] : pairs)
        json[key] = value;
    return json;
}

Json kernelsJson(const gpu::KernelTimes& kernels) {
    Json json = Json::object();
    for (const auto& [name, time] : kernels)
        json[name] = {{"seconds", time.seconds}, {"dispatches", time.dispatches}};
    return json;
}

std::string textOf(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json stagesJson(const StageTimes& stages) {
    Json json = Json::object();
    for (const auto& [name, seconds] : stages)
        json[name] = seconds;
    return json;
}

Json raysJson(const RenderReport& report) {
    return {{"camera", report.rays.camera},
            {"indirect", report.rays.indirect},
            {"shadow", report.rays.shadow},
            {"perSecond", perSecond(report.rays.total(), report.renderSeconds)}};
}

Json phasesJson(const RenderSettings& settings) {
    Json json = Json::array();
    for (const Phase& phase : phasesOf(settings))
        json.push_back({{"transport", phase.transport->name},
                        {"firstSample", phase.firstSample},
                        {"samples", phase.samples}});
    return json;
}

Json ledgerJson(const std::vector<LedgerEntry>& ledger) {
    Json json = Json::array();
    for (const LedgerEntry& entry : ledger)
        json.push_back({{"cause", entry.cause}, {"detail", entry.detail}});
    return json;
}

std::vector<std::string> objectNames(const Scene& scene) {
    std::vector<std::string> names = scene.objects;
    for (const Mesh& mesh : scene.meshes)
        for (size_t i = names.size(); i <= mesh.object; ++i)
            names.push_back(fmt::format("object {}", i));
    return names;
}

std::vector<std::string> materialNames(const Scene& scene) {
    std::vector<std::string> names;
    for (size_t i = 0; i < scene.materials.size(); ++i)
        names.push_back(scene.materials[i].name.empty() ? fmt::format("material {}", i)
                                                        : scene.materials[i].name);
    return names;
}

Json samplesJson(const RenderReport& report) {
    return {{"total", report.samples},
            {"perSecond", perSecond(report.samples, report.renderSeconds)},
            {"dropped", report.tallies.droppedSamples},
            {"negative", report.tallies.negativeSamples}};
}

Json toneJson(const ToneSettings& tone) {
    return {{"tonemap", nameOf(tone.curve)}, {"exposure", tone.exposure}};
}

Json errorJson(const RenderReport& report, bool isUpperBound) {
    const double cost = report.meanVariance * report.renderSeconds;
    return {{"meanVariance", report.meanVariance},
            {"estimatedRelMse", report.errorEstimate},
            {"isUpperBound", isUpperBound},
            {"efficiency", cost > 0.0 ? 1.0 / cost : 0.0}};
}

Json meanJson(const RenderReport& report) {
    return {report.meanRadiance.x, report.meanRadiance.y, report.meanRadiance.z};
}

glm::dvec3 meanOf(const Image& image) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& pixel : image.pixels)
        sum += glm::dvec3(pixel);
    return sum / static_cast<double>(image.pixels.size());
}

// The estimates of a rendering as a whole.
void fillMeans(RenderReport& report, const Rendering& rendering) {
    report.samples = rendering.samples();
    report.meanRadiance = meanOf(rendering.radiance());
    const glm::dvec3 variance = meanOf(rendering.variance());
    report.meanVariance = (variance.x + variance.y + variance.z) / 3.0;
    report.errorEstimate = errorEstimate(rendering);
}

constexpr std::string_view kOption = "option:";
constexpr std::string_view kOfFilm = "film:"; // how keys begin that only files with a film have
constexpr std::string_view kSobol = "sobol";  // as describe() has the sampler

Json optionsJson(const Metadata& metadata) {
    Json json = Json::object();
    for (const auto& [key, value] : metadata)
        if (key.starts_with(kOption))
            json[key.substr(kOption.size())] = value;
    return json;
}

} // namespace

void fillInputs(RenderReport& report, const Scene& scene, const RenderSettings& settings) {
    report.settings = settings;
    report.scene = scene.source;
    report.origin = scene.origin;
    report.triangles = scene.triangleCount();
    report.warnings = scene.warnings;
    const FilmLayout layout = layoutOf(filmPlanes(settings));
    for (const std::string& layer : layout.idLayers())
        report.idNames[layer] = layer == layerNameOf(kObjectIds) ? objectNames(scene) : materialNames(scene);
}

void fillResults(RenderReport& report, const Renderer& renderer, const gpu::Device& device,
                 const Rendering& rendering, const Scene& scene) {
    report.device = device.description();
    report.accelerator = nameOf(renderer.settings().work.accelerator);
    report.content = fingerprintsOf(renderer);
    report.kernels = renderer.waves().kernelTimes();
    report.rays = renderer.waves().rays();
    report.tallies = renderer.film().readTallies();
    report.sceneBytes = renderer.scene().bytes();
    report.peakDeviceBytes = device.peakAllocatedBytes();
    fillMeans(report, rendering);
    report.ledger = makeLedger(scene, report.settings, report.tallies, report.stop);
}

Metadata exrMetadata(const RenderReport& report) {
    Metadata metadata{
        {"version", std::string(kVersion)},
        {"scene", report.scene},
        {"camera", report.camera},
        {"device", report.device.name},
        {"driver", report.device.driver},
        {"samples-per-pixel", samplesPerPixel(report.samples, windowOf(report.settings.image).pixels())},
        {"render-seconds", fmt::format("{:.3f}", report.renderSeconds)},
        {"complete", report.stop == StopReason::interrupted ? "no, interrupted" : "yes"},
        {"bias-ledger", ledgerText(report.ledger)}};
    if (!kCommit.empty())
        metadata.emplace_back("commit", kCommit);
    if (report.device.isCpu) // a card's bits do not depend on it
        metadata.emplace_back("processor", processorKind());
    if (report.origin != glm::dvec3(0.0))
        metadata.emplace_back("origin",
                              fmt::format("{},{},{}", report.origin.x, report.origin.y, report.origin.z));
    for (const auto& [layer, names] : report.idNames)
        metadata.emplace_back(namesKey(layer), textOf(names));
    for (const auto& [key, value] : describeOptions(report))
        metadata.emplace_back(std::string(kOption) + key, value);
    for (const auto& [part, hash] : report.content)
        metadata.emplace_back("content:" + part, hash);
    return metadata;
}

std::string reportJson(const RenderReport& report) {
    Json json;
    json["version"] = kVersion;
    json["commit"] = kCommit;
    json["scene"] = report.scene;
    json["camera"] = report.camera;
    json["origin"] = {report.origin.x, report.origin.y, report.origin.z};
    json["triangles"] = report.triangles;
    json["device"] = {{"name", report.device.name},
                      {"driver", report.device.driver},
                      {"type", report.device.type},
                      {"api", report.device.apiVersion}};
    json["accelerator"] = report.accelerator;
    json["processor"] = processorKind();
    json["settings"] = pairsJson(describeOptions(report));
    if (report.tone)
        json["png"] = toneJson(*report.tone);
    json["phases"] = phasesJson(report.settings);
    json["waveSize"] = report.settings.work.waveSize;
    json["complete"] = report.stop != StopReason::interrupted;
    json["stoppedBy"] = nameOf(report.stop);
    json["seconds"] = stagesJson(report.stages);
    json["kernels"] = kernelsJson(report.kernels);
    json["rays"] = raysJson(report);
    json["samples"] = samplesJson(report);
    json["meanRadiance"] = meanJson(report);
    // Sobol's samples are correlated, so that the film's variance overstates theirs.
    json["error"] = errorJson(report, report.settings.estimator.sampler == Sampler::sobol);
    json["memory"] = {{"sceneBytes", report.sceneBytes}, {"peakDeviceBytes", report.peakDeviceBytes}};
    json["ledger"] = ledgerJson(report.ledger);
    json["warnings"] = report.warnings;
    return textOf(json);
}

std::string filmReportJson(const FilmFile& film, const Rendering& rendering,
                           const std::vector<LedgerEntry>& ledger, const std::optional<ToneSettings>& tone) {
    const auto header = [&](const char* key) { return valueOf(film.metadata, key); };
    const FilmCost cost = costOf(film);
    RenderReport report;
    report.renderSeconds = cost.seconds;
    report.rays = cost.rays;
    report.tallies = readable(film.film.tallies);
    fillMeans(report, rendering);
    Json json;
    for (const char* key : {"version", "commit", "scene", "camera"})
        json[key] = header(key);
    json["device"] = {{"name", header("device")}, {"driver", header("driver")}};
    json["processor"] = header("processor");
    json["settings"] = optionsJson(film.metadata);
    if (tone)
        json["png"] = toneJson(*tone);
    json["complete"] = film.isComplete();
    json["stoppedBy"] = nameOf(film.isComplete() ? StopReason::samples : StopReason::interrupted);
    json["ranges"] = textOf(film.ranges);
    json["seconds"] = {{"render", report.renderSeconds}};
    json["rays"] = raysJson(report);
    json["samples"] = samplesJson(report);
    json["meanRadiance"] = meanJson(report);
    json["error"] = errorJson(report, header("option:sampler") == kSobol);
    json["ledger"] = ledgerJson(ledger);
    json["warnings"] = Json::array();
    return textOf(json);
}

Metadata exrMetadata(const FilmFile& film, const std::vector<LedgerEntry>& ledger) {
    Metadata metadata = film.metadata;
    std::erase_if(metadata, [](const auto& pair) { return pair.first.starts_with(kOfFilm); });
    setValue(metadata, "bias-ledger", ledgerText(ledger));
    return metadata;
}

} // namespace lavalight
