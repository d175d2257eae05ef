#include "cli/options/camera_options.h"

#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/options/named_option.h"
#include "cli/options/option_values.h"

namespace lavalight {
namespace {

// An option that was not given has an empty text; so has one that was given as "".
template <typename Number, glm::length_t Length = 3>
std::optional<glm::vec<Length, Number>> vectorOf(const CLI::Option& option, const std::string& text) {
    if (option.count() == 0)
        return std::nullopt;
    const auto vector = parseVector<Number, Length>(text);
    if (!vector)
        throw UsageError(
            fmt::format("{}: \"{}\" is not {}", option.get_name(), text, option.get_type_name()));
    return vector;
}

} // namespace

CameraOptions::CameraOptions(CLI::App& parser) : parser_(&parser) {
    parser.add_option("--camera", choice_.name, "Camera by name or index; default: the first")
        ->type_name("NAME|INDEX");
    parser.add_option("--look-from", from_, "A camera at this place; with --look-at, instead of the scene's")
        ->type_name("X,Y,Z");
    parser.add_option("--look-at", at_, "The point in the middle of the image")->type_name("X,Y,Z");
    parser.add_option("--up", up_, "What is up for --look-from; default: 0,1,0")->type_name("X,Y,Z");
    addNamed(
        parser, "--view", choice_.view,
        "Frame the scene from there, whatever cameras it has: every vertex is in the image, with a margin");
    parser.add_option("--fov", choice_.fov, "Vertical field of view, above 0 and below 180")
        ->type_name("DEGREES");
    parser
        .add_option(
            "--intrinsics", intrinsics_,
            "Focal lengths and principal point in pixels, instead of a field of view; the point counts "
            "from the image's top left corner, 0.5 more than from the middle of its first pixel")
        ->type_name("FX,FY,CX,CY");
    parser.add_option("--aperture", choice_.aperture, "Diameter of the lens; 0: all is sharp")
        ->type_name("METRES");
    parser
        .add_option("--focus", choice_.focus,
                    "Distance to the plane that is sharp, along the view; default: to --look-at, else to the "
                    "middle of the scene")
        ->type_name("METRES");
    parser.add_flag("--panorama", choice_.panorama,
                    "All directions around the camera, laid out as environment maps are");
    parser
        .add_option("--clip", clip_,
                    "See what lies between these distances along the view, instead of between the planes of "
                    "the camera")
        ->type_name("NEAR,FAR");
    parser.add_flag("--no-clip", choice_.seesAll,
                    "See what is nearer than the camera's znear or beyond its zfar, too");
}

CameraChoice CameraOptions::choice() const {
    CameraChoice choice = choice_;
    choice.lookFrom = vectorOf<double>(*parser_->get_option("--look-from"), from_);
    choice.lookAt = vectorOf<double>(*parser_->get_option("--look-at"), at_);
    choice.up = vectorOf<float>(*parser_->get_option("--up"), up_);
    if (const auto numbers = vectorOf<double, 4>(*parser_->get_option("--intrinsics"), intrinsics_))
        choice.intrinsics = Intrinsics{{numbers->x, numbers->y}, {numbers->z, numbers->w}};
    choice.clip = vectorOf<float, 2>(*parser_->get_option("--clip"), clip_);
    return choice;
}

} // namespace lavalight
