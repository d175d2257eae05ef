// What a render was and what it cost: the JSON report and the EXR header.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "film/film_file.h"
#include "gltf/import_options.h"
#include "gpu/device.h"
#include "image/exr.h"
#include "render/render_fingerprint.h"
#include "render/renderer.h"
#include "render/settings.h"
#include "render/tone_settings.h"
#include "session/ledger.h"

namespace lavalight {

// Wall-clock seconds of the stages, in order; then of parts of "prepare", which run side by side, and from
// the start of the process to the end of the first wave.
using StageTimes = std::vector<std::pair<std::string, double>>;

struct RenderReport {
    std::string scene;
    glm::dvec3 origin{0.0};                                  // the scene's, in its world
    std::map<std::string, std::vector<std::string>> idNames; // of objects or materials, by the layers of ids
    ImportOptions import; // which moment and variant of the scene were shown
    std::string camera;
    RenderSettings settings;
    gpu::DeviceDescription device;
    std::string accelerator; // by its name as a setting
    Fingerprints content;    // fingerprints of what was rendered
    StageTimes stages;
    double renderSeconds = 0.0;
    gpu::KernelTimes kernels;
    RayCounts rays;
    uint64_t samples = 0; // over all pixels
    FilmTallies tallies;
    uint64_t sceneBytes = 0;
    uint64_t peakDeviceBytes = 0;
    uint64_t triangles = 0;
    std::vector<LedgerEntry> ledger;
    std::vector<std::string> warnings;
    glm::dvec3 meanRadiance{0.0};
    double meanVariance = 0.0;  // variance of the pixels' means, averaged over pixels and channels
    double errorEstimate = 0.0; // see errorEstimate()
    StopReason stop = StopReason::samples;
    std::optional<ToneSettings> tone; // tone mapping of the PNG, if there is one
};

// Fills in the inputs: what was asked for.
void fillInputs(RenderReport& report, const Scene& scene, const RenderSettings& settings);
// Fills in the results, with the ledger. `rendering` is the renderer's; the inputs are there already.
void fillResults(RenderReport& report, const Renderer& renderer, const gpu::Device& device,
                 const Rendering& rendering, const Scene& scene);

[[nodiscard]] Metadata exrMetadata(const RenderReport& report);
[[nodiscard]] std::string reportJson(const RenderReport& report);

// The JSON report of a film that was rendered elsewhere: what its header and its samples say. `rendering`:
// the film's; `ledger`: its header's, and what has been done to the rendering since.
[[nodiscard]] std::string filmReportJson(const FilmFile& film, const Rendering& rendering,
                                         const std::vector<LedgerEntry>& ledger,
                                         const std::optional<ToneSettings>& tone);
// The header of a file that shows such a film and does not hold it: exrMetadata() of one render of all its
// samples.
[[nodiscard]] Metadata exrMetadata(const FilmFile& film, const std::vector<LedgerEntry>& ledger);

} // namespace lavalight
