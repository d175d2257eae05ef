#include "cli/options/crop_options.h"

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {

CropOptions::CropOptions(CLI::App& parser) {
    parser
        .add_option(
            "--crop", crop_,
            "Renders these pixels of the image alone, counted from its top left corner, with the bits that "
            "the whole has there; the EXR can be joined with other parts (see lavalight merge)")
        ->type_name("X,Y,WxH");
}

std::optional<PixelWindow> CropOptions::window() const {
    if (crop_.empty())
        return std::nullopt;
    const std::optional<PixelWindow> window = parsePixelWindow(crop_);
    if (!window)
        throw UsageError(
            fmt::format("--crop: \"{}\" is not X,Y,WxH: the corner and the size of a part of the "
                        "image, in pixels",
                        crop_));
    return window;
}

} // namespace lavalight
