// Intel Open Image Denoise, which is looked for when it is asked for: nothing of it is needed to build.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "image/image.h"

namespace lavalight {

enum class DenoiseQuality {
    fast, // for windows
    balanced,
    high // the guides are denoised first
};

enum class ImageKind { radiance, display };

// What a denoiser is told of an image besides its colour. All images have one size.
struct DenoiseGuides {
    Image albedo; // in [0, 1]
    Image normal; // means of unit vectors
};

// Asked now and then while an image is denoised; false gives it up.
using KeepGoing = std::function<bool()>;

class Denoiser {
  public:
    // Loads the library, 2.0 or newer: from the file or folder that LAVALIGHT_OIDN names, the system's paths,
    // the folder where `tools/setup --denoiser` puts it, or the Python package pyoidn. Throws Error that says
    // how to get it.
    Denoiser();
    ~Denoiser();
    Denoiser(const Denoiser&) = delete;
    Denoiser& operator=(const Denoiser&) = delete;

    // The version of the library: "2.5.1".
    [[nodiscard]] std::string version() const;

    // `color`: finite and not negative, of any brightness or in [0, 1], as `kind` says.
    // Nothing where `keepGoing` gave it up; without one, there is an image. Not for two threads at a time.
    // Throws Error as the library does.
    [[nodiscard]] std::optional<Image> denoise(const Image& color, const DenoiseGuides& guides,
                                               DenoiseQuality quality, ImageKind kind = ImageKind::radiance,
                                               const KeepGoing& keepGoing = {}) const;

  private:
    struct Library;
    std::unique_ptr<Library> library_;
};

} // namespace lavalight
