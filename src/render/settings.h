// What a render is asked to do.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "film/film_windows.h"
#include "render/estimator_settings.h"
#include "scene/procedural/sky_environment.h"
#include "shared/film.h"

namespace lavalight {

// Options of the command line: names without dashes, and values.
using OptionPairs = std::vector<std::pair<std::string, std::string>>;

// How the work of a path is cut up. Bits may differ, where a driver rounds otherwise in another kernel.
enum class Schedule {
    automatic, // by the kind of device
    fused,     // one kernel for whole paths
    wavefront, // a kernel for each step of a bounce
    hosted     // kernels shade, the host traces: for devices that share its memory
};

// What finds the triangles that rays meet. Bits may differ where they round otherwise.
enum class RayAccelerator {
    automatic, // by the schedule and the device
    bvh8,      // our own tree, traversed by kernels
    bvh16,     // our own tree, traversed by the host: with the schedule hosted
    embree,    // Embree's tree, the same
    rayQuery   // the device's own tree and traversal (VK_KHR_ray_query), asked by kernels
};

// Whether the host traverses it, and kernels trace nothing.
[[nodiscard]] constexpr bool isOnHost(RayAccelerator accelerator) {
    return accelerator == RayAccelerator::bvh16 || accelerator == RayAccelerator::embree;
}

// The image, and which samples of each pixel are taken, at most StopRule::samples of them.
struct ImageSettings {
    uint32_t width = 0; // pixels; 0: by the camera's aspect ratio from the height
    uint32_t height = 512;
    uint32_t firstSample = 0;          // samples before it are left to other renders
    std::optional<PixelWindow> crop{}; // what of the image is rendered; none: all of it
    bool operator==(const ImageSettings&) const = default;
};

// The pixels that are rendered, of an image whose sides are settled.
[[nodiscard]] PixelWindow windowOf(const ImageSettings& image);
// What of the image that is.
[[nodiscard]] FilmPart partOf(const ImageSettings& image);

// When a render has enough.
struct StopRule {
    uint32_t samples = 64;      // per pixel, at most
    double seconds = 0.0;       // stop after this time; 0: no limit
    double targetError = 0.0;   // stop when the estimated relMSE is below this; 0: no target
    bool isProgressive = false; // passes start with one sample, so that every pixel soon has some
    bool operator==(const StopRule&) const = default;
};

// How the work is cut up. Wave size and band rows change no bit of the image.
struct WorkSettings {
    Schedule schedule = Schedule::automatic;
    RayAccelerator accelerator = RayAccelerator::automatic;
    uint32_t waveSize = 0; // path slots of a wave; 0: by the schedule
    uint32_t bandRows = 0; // rows of a film band; 0: as many as a storage buffer of the device holds
    bool operator==(const WorkSettings&) const = default;
};

// Environments that are computed.
enum class ProceduralEnvironment {
    none,
    studio, // makeStudio()
    sky     // makeSky()
};

// What shines where nothing is hit. At most one of the first three says something.
struct LightingSettings {
    std::optional<glm::vec3> constant; // radiance that replaces the scene's environment
    std::string mapFile;               // where Scene::environmentMap came from; empty: nowhere
    ProceduralEnvironment procedural = ProceduralEnvironment::none;
    SkySettings sky;
    float rotation = 0.0f;  // turn of the map about +Y, degrees, counter-clockwise seen from above
    float intensity = 1.0f; // multiplies the environment, whatever it is
    bool operator==(const LightingSettings&) const = default;
};

// Whether the settings bring light of their own.
[[nodiscard]] inline bool bringsLight(const LightingSettings& lighting) {
    return lighting.constant.has_value() || !lighting.mapFile.empty() ||
           lighting.procedural != ProceduralEnvironment::none;
}

// What camera rays see that meet nothing.
enum class Background {
    environment, // what shines from there
    transparent, // nothing: the film has a plane of coverage, and colour is associated (premultiplied)
    constant
};

struct BackgroundSettings {
    Background kind = Background::environment;
    glm::vec3 radiance{0.0f}; // of Background::constant
    bool operator==(const BackgroundSettings&) const = default;
};

// What lies below the scene.
enum class Ground {
    none,
    lambert, // a surface, which is part of the scene (scene/ground.h)
    shadow   // a plane at Scene::groundHeight that only camera rays see: its shadow is part of alpha
};

struct GroundSettings {
    Ground kind = Ground::none;
    uint32_t color = 0; // of Ground::lambert: sRGB signals, 0xrrggbb
    bool operator==(const GroundSettings&) const = default;
};

// Where the render's inputs came from: for the record alone.
struct Provenance {
    std::vector<std::string> changedShaders; // by --shaders
    OptionPairs cameraOptions;               // as given
    bool operator==(const Provenance&) const = default;
};

// A render of a scene as seen by a camera.
struct RenderSettings {
    EstimatorSettings estimator;
    ImageSettings image;
    StopRule stop;
    WorkSettings work;
    LightingSettings lighting;
    BackgroundSettings background;
    GroundSettings ground;
    uint32_t layers =
        0; // further layers: bit i for row i of FILM_PLANES, kObjectIds, kMaterialIds, kCryptomatte
    Provenance provenance;
    bool operator==(const RenderSettings&) const = default;
};

// Further planes that denoising reads: light that is seen directly, and the guides.
inline constexpr uint32_t kDenoisingLayers =
    1u << kEmissionPlane | 1u << kGuideAlbedoPlane | 1u << kGuideNormalPlane;

// The planes of the render's film: bit i for row i of FILM_PLANES, kNegativeWeights, and layers of ids
// (shaders/shared/film.h).
[[nodiscard]] uint32_t filmPlanes(const RenderSettings& settings);

constexpr uint32_t kMaxBounceLimit = 1024; // counters of every bounce are kept for the whole wave

// Throws UsageError naming the option and its range, or the options that contradict each other.
void checkSettings(const RenderSettings& settings);

// Option name (without dashes) and value of everything that decides the image's bits, for the EXR header and
// report.
[[nodiscard]] OptionPairs describe(const RenderSettings& settings);

} // namespace lavalight
