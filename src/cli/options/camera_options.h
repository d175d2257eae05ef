// The options that say where the camera is and how it projects.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "render/settings.h"
#include "scene/scene.h"

namespace lavalight {

// Declares options on a parser and turns their values into a camera. Must outlive the parsing; the parser
// points into it.
class CameraOptions {
  public:
    explicit CameraOptions(CLI::App& parser);
    CameraOptions(const CameraOptions&) = delete;
    CameraOptions& operator=(const CameraOptions&) = delete;

    // The scene's camera asked for by name or index, else the first, changed by the other options. Throws
    // UsageError naming the option and what it takes, or the cameras there are.
    [[nodiscard]] Camera cameraOf(const Scene& scene) const;

    // Names (without dashes) and values of the options that were given and that the camera's name does not
    // tell.
    [[nodiscard]] OptionPairs given() const;

  private:
    [[nodiscard]] bool isGiven(const char* option) const { return parser_->count(option) > 0; }
    void aim(Camera& camera) const;
    void setLens(const Scene& scene, Camera& camera) const;

    CLI::App* parser_; // asked which options were given
    std::string name_;
    std::string from_;
    std::string at_;
    std::string up_;
    float fov_ = 45.0f; // degrees
    float aperture_ = 0.0f;
    float focus_ = 0.0f;
    bool panorama_ = false;
};

} // namespace lavalight
