#include "denoise/denoiser.h"

#include <cassert>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/os/environment.h"
#include "base/os/shared_library.h"
#include "base/parallel.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFileName = "libOpenImageDenoise.so.2";
constexpr const char* kVariable = "LAVALIGHT_OIDN";

// Names and values of Open Image Denoise's C interface, which 2.x keeps.
struct Device;
struct Filter;
constexpr int kDeviceOfProcessor = 1;
constexpr int kFloat3 = 3;
constexpr int kQualityFast = 4;
constexpr int kQualityBalanced = 5;
constexpr int kQualityHigh = 6;
constexpr int kCancelled = 6; // of errors
using Monitor = bool (*)(void*, double);

int qualityOf(DenoiseQuality quality) {
    switch (quality) {
    case DenoiseQuality::fast:
        return kQualityFast;
    case DenoiseQuality::balanced:
        return kQualityBalanced;
    case DenoiseQuality::high:
        break;
    }
    return kQualityHigh;
}

// lib/python3.*/site-packages and dist-packages below a folder.
void addPythonPackages(const fs::path& root, std::vector<fs::path>& files) {
    std::error_code code;
    for (const fs::directory_entry& python : fs::directory_iterator(root / "lib", code))
        if (python.path().filename().string().starts_with("python3"))
            for (const char* packages : {"site-packages", "dist-packages"})
                files.push_back(python.path() / packages / "pyoidn/oidn/lib" / kFileName);
}

// Files that may be the library, in order.
std::vector<fs::path> candidates() {
    std::vector<fs::path> files{kFileName};
    const std::optional<fs::path> home = environmentPath("HOME");
    if (const auto data = environmentPath("XDG_DATA_HOME"))
        files.push_back(*data / "lavalight/oidn/lib" / kFileName);
    else if (home)
        files.push_back(*home / ".local/share/lavalight/oidn/lib" / kFileName);
    if (const auto environment = environmentPath("VIRTUAL_ENV"))
        addPythonPackages(*environment, files);
    if (home)
        addPythonPackages(*home / ".local", files);
    addPythonPackages("/usr/local", files);
    addPythonPackages("/usr", files);
    return files;
}

SharedLibrary load() {
    if (const auto named = environmentPath(kVariable)) {
        std::error_code code;
        fs::path file = fs::is_directory(*named, code) ? *named / kFileName : *named;
        if (fs::is_directory(*named / "lib", code))
            file = *named / "lib" / kFileName;
        if (!fs::exists(file, code))
            throw Error(
                fmt::format("cannot denoise: there is no {}, which {} names", file.string(), kVariable));
        return SharedLibrary(file);
    }
    for (const fs::path& file : candidates()) {
        std::error_code code;
        if (file.has_parent_path() && !fs::exists(file, code))
            continue;
        try {
            return SharedLibrary(file);
        } catch (const Error&) {
            if (file.has_parent_path()) // it is there, and cannot be used
                throw;
        }
    }
    throw Error(fmt::format(
        "cannot denoise: there is no Open Image Denoise ({}); get it by \"tools/setup --denoiser\" or "
        "\"pip install pyoidn\", or name its folder in {}",
        kFileName, kVariable));
}

} // namespace

struct Denoiser::Library {
    SharedLibrary file = load();
    Device* (*newDevice)(int) = file.function<Device*(int)>("oidnNewDevice");
    void (*commitDevice)(Device*) = file.function<void(Device*)>("oidnCommitDevice");
    void (*setDeviceInt)(Device*, const char*,
                         int) = file.function<void(Device*, const char*, int)>("oidnSetDeviceInt");
    void (*releaseDevice)(Device*) = file.function<void(Device*)>("oidnReleaseDevice");
    int (*deviceInt)(Device*, const char*) = file.function<int(Device*, const char*)>("oidnGetDeviceInt");
    int (*error)(Device*, const char**) = file.function<int(Device*, const char**)>("oidnGetDeviceError");
    Filter* (*newFilter)(Device*,
                         const char*) = file.function<Filter*(Device*, const char*)>("oidnNewFilter");
    void (*setImage)(Filter*, const char*, void*, int, size_t, size_t, size_t, size_t, size_t) =
        file.function<void(Filter*, const char*, void*, int, size_t, size_t, size_t, size_t, size_t)>(
            "oidnSetSharedFilterImage");
    void (*setBool)(Filter*, const char*,
                    bool) = file.function<void(Filter*, const char*, bool)>("oidnSetFilterBool");
    void (*setInt)(Filter*, const char*,
                   int) = file.function<void(Filter*, const char*, int)>("oidnSetFilterInt");
    void (*setMonitor)(Filter*, Monitor, void*) =
        file.function<void(Filter*, Monitor, void*)>("oidnSetFilterProgressMonitorFunction");
    void (*commitFilter)(Filter*) = file.function<void(Filter*)>("oidnCommitFilter");
    void (*execute)(Filter*) = file.function<void(Filter*)>("oidnExecuteFilter");
    void (*releaseFilter)(Filter*) = file.function<void(Filter*)>("oidnReleaseFilter");
    Device* device = nullptr;

    Library() = default;
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() {
        if (device != nullptr)
            releaseDevice(device);
    }

    // Throws Error; false: it was given up.
    bool requireNoError() const {
        const char* message = nullptr;
        const int code = error(device, &message);
        if (code != 0 && code != kCancelled)
            throw Error(fmt::format("cannot denoise: {}",
                                    message != nullptr ? message : "Open Image Denoise failed"));
        return code == 0;
    }

    // A filter for ray-traced images, released at the end.
    [[nodiscard]] auto makeFilter() const {
        return std::unique_ptr<Filter, void (*)(Filter*)>(newFilter(device, "RT"), releaseFilter);
    }

    // The library reads inputs and writes the output alone.
    void give(Filter* filter, const char* name, const Image& image) const {
        static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
        auto* pixels = const_cast<glm::vec3*>(image.pixels.data());
        setImage(filter, name, pixels, kFloat3, image.width, image.height, 0, 0, 0);
    }

    // False: `keepGoing` gave it up.
    [[nodiscard]] bool run(Filter* filter, DenoiseQuality quality, const KeepGoing& keepGoing) const {
        setInt(filter, "quality", qualityOf(quality));
        if (keepGoing)
            setMonitor(
                filter, [](void* asked, double) { return (*static_cast<const KeepGoing*>(asked))(); },
                const_cast<KeepGoing*>(&keepGoing));
        commitFilter(filter);
        execute(filter);
        return requireNoError();
    }

    [[nodiscard]] std::optional<Image> prefiltered(const char* name, const Image& guide,
                                                   const KeepGoing& keepGoing) const {
        Image clean(guide.width, guide.height);
        const auto filter = makeFilter();
        give(filter.get(), name, guide);
        give(filter.get(), "output", clean);
        return run(filter.get(), DenoiseQuality::high, keepGoing) ? std::optional(clean) : std::nullopt;
    }
};

Denoiser::Denoiser() : library_(std::make_unique<Library>()) {
    library_->device = library_->newDevice(kDeviceOfProcessor);
    library_->setDeviceInt(library_->device, "numThreads", static_cast<int>(threadLimit()));
    library_->commitDevice(library_->device);
    library_->requireNoError();
}

Denoiser::~Denoiser() = default;

std::string Denoiser::version() const {
    const auto part = [&](const char* name) { return library_->deviceInt(library_->device, name); };
    return fmt::format("{}.{}.{}", part("versionMajor"), part("versionMinor"), part("versionPatch"));
}

std::optional<Image> Denoiser::denoise(const Image& color, const DenoiseGuides& guides,
                                       DenoiseQuality quality, ImageKind kind,
                                       const KeepGoing& keepGoing) const {
    const bool isClean = quality == DenoiseQuality::high;
    std::optional<Image> albedo;
    std::optional<Image> normal;
    if (isClean) {
        albedo = library_->prefiltered("albedo", guides.albedo, keepGoing);
        normal = albedo ? library_->prefiltered("normal", guides.normal, keepGoing) : std::nullopt;
        if (!normal)
            return std::nullopt;
    }
    Image output(color.width, color.height);
    const auto filter = library_->makeFilter();
    library_->give(filter.get(), "color", color);
    library_->give(filter.get(), "albedo", isClean ? *albedo : guides.albedo);
    library_->give(filter.get(), "normal", isClean ? *normal : guides.normal);
    library_->give(filter.get(), "output", output);
    library_->setBool(filter.get(), "hdr", kind == ImageKind::radiance);
    library_->setBool(filter.get(), "cleanAux", isClean);
    return library_->run(filter.get(), quality, keepGoing) ? std::optional(std::move(output)) : std::nullopt;
}

} // namespace lavalight
