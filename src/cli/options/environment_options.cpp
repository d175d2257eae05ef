#include "cli/options/environment_options.h"

#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "base/error.h"
#include "cli/options/option_values.h"
#include "image/environment_file.h"
#include "render/setting_names.h"

namespace lavalight {
namespace {

bool isMapName(const std::string& text) {
    return hasEnvironmentExtension(text) || std::filesystem::exists(text);
}

} // namespace

EnvironmentOptions::EnvironmentOptions(CLI::App& parser) : parser_(&parser) {
    parser
        .add_option(
            "--env", environment_,
            "Environment that replaces the scene's: a photographer's studio, a clear sky with its sun, "
            "constant radiance (white: "
            "1,1,1), or a .hdr or .exr map (its middle looks along +X, its right half towards +Z, its "
            "top along +Y). A file without light has the studio")
        ->type_name("studio|sky|white|R,G,B|FILE");
    parser
        .add_option("--sun-elevation", sky_.sunElevation, "Of --env sky: degrees above the horizon, 0 to 90")
        ->type_name("DEGREES");
    parser
        .add_option("--sun-azimuth", sky_.sunAzimuth, "Of --env sky: degrees from +Z towards +X, -360 to 360")
        ->type_name("DEGREES");
    parser.add_option("--turbidity", sky_.turbidity, "Of --env sky: from 1, clear air, to 10, haze")
        ->type_name("T");
    parser
        .add_option("--env-rotation", rotation_,
                    "Turns the map about +Y, counter-clockwise as seen from above (from +X to -Z)")
        ->type_name("DEGREES");
    parser.add_option("--env-intensity", intensity_, "Multiplies the environment, whatever it is")
        ->type_name("X");
}

LightingSettings EnvironmentOptions::lighting() const {
    LightingSettings lighting;
    lighting.rotation = rotation_;
    lighting.intensity = intensity_;
    if (environment_ == "white") {
        lighting.constant = glm::vec3(1.0f);
    } else if (environment_ == nameOf(ProceduralEnvironment::studio)) {
        lighting.procedural = ProceduralEnvironment::studio;
    } else if (environment_ == nameOf(ProceduralEnvironment::sky)) {
        lighting.procedural = ProceduralEnvironment::sky;
        lighting.sky = sky_;
    } else if (const std::optional<glm::vec3> radiance = parseVector<float>(environment_)) {
        if (glm::any(glm::lessThan(*radiance, glm::vec3(0.0f))))
            throw UsageError(fmt::format("--env: a radiance in \"{}\" is below 0", environment_));
        lighting.constant = radiance;
    } else if (isMapName(environment_)) {
        lighting.mapFile = environment_;
    } else if (parser_->count("--env") > 0) {
        throw UsageError(fmt::format(
            "--env: \"{}\" is neither studio, nor sky, nor white, nor R,G,B with three radiances of 0 "
            "or more, nor the name of a .hdr or .exr file",
            environment_));
    }
    if (parser_->count("--env-rotation") > 0 && lighting.constant)
        throw UsageError("--env-rotation: cannot turn the environment: it is not a map; try --env studio");
    for (const char* option : {"--sun-elevation", "--sun-azimuth", "--turbidity"})
        if (parser_->count(option) > 0 && lighting.procedural != ProceduralEnvironment::sky)
            throw UsageError(
                fmt::format("{}: cannot change the sky: the environment is not one; try --env sky", option));
    return lighting;
}

} // namespace lavalight
