#include "cli/options/background_options.h"

#include <fmt/format.h>

#include "base/error.h"
#include "cli/options/option_values.h"
#include "image/srgb.h"

namespace lavalight {

BackgroundOptions::BackgroundOptions(CLI::App& parser) {
    parser
        .add_option(
            "--background", background_,
            "What is seen behind the scene: the environment; nothing (EXR and PNG get an alpha channel); a "
            "colour of the PNG, as it arrives on the screen; or a radiance. What glass and mirrors show "
            "of the environment stays")
        ->type_name("environment|transparent|#rrggbb|R,G,B");
}

BackgroundSettings BackgroundOptions::settings() const {
    if (background_ == "environment")
        return {};
    if (background_ == "transparent" || parseHexColor(background_))
        return {Background::transparent, glm::vec3(0.0f)};
    const std::optional<glm::vec3> radiance = parseVector<float>(background_);
    if (!radiance || glm::any(glm::lessThan(*radiance, glm::vec3(0.0f))))
        throw UsageError(
            fmt::format("--background: \"{}\" is neither environment, nor transparent, nor a colour "
                        "#rrggbb, nor R,G,B with three radiances of 0 or more",
                        background_));
    return {Background::constant, *radiance};
}

std::optional<glm::vec3> BackgroundOptions::color() const {
    const std::optional<uint32_t> code = parseHexColor(background_);
    if (!code)
        return std::nullopt;
    const auto channel = [&](uint32_t shift) { return static_cast<float>(*code >> shift & 0xffu) / 255.0f; };
    return glm::vec3(channel(16), channel(8), channel(0));
}

std::optional<glm::vec3> BackgroundOptions::backdrop() const {
    const std::optional<uint32_t> code = parseHexColor(background_);
    return code ? std::optional(decodeSrgb8(*code)) : std::nullopt;
}

} // namespace lavalight
