// What a caller may choose where a file holds more than one scene to show.
#pragma once

#include <optional>
#include <string>

#include <glm/glm.hpp>

namespace lavalight {

struct ImportOptions {
    std::optional<double> seconds{}; // the animations' time; none: nodes stay where the file places them
    std::string animation{};         // animation by name or index; empty: the first
    std::string scene{};             // scene by name or index; empty: the file's default
    std::string variant{};           // variant of the materials, by name or index; empty: none
    // What the caller looks from decides where coordinates are finest: a place in the world, or a camera by
    // name or index; neither: the first camera.
    std::optional<glm::dvec3> viewpoint{};
    std::string camera{};
    bool allowsExternal = false; // the file may refer to files outside its folder
};

} // namespace lavalight
