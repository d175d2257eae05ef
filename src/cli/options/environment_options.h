// The options that say what shines where nothing is hit.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "gltf/import_options.h"
#include "render/settings.h"
#include "scene/scene.h"

namespace lavalight {

// Declares options on a parser and turns their values into settings. Must outlive the parsing; the parser
// points into it.
class EnvironmentOptions {
  public:
    explicit EnvironmentOptions(CLI::App& parser);
    EnvironmentOptions(const EnvironmentOptions&) = delete;
    EnvironmentOptions& operator=(const EnvironmentOptions&) = delete;

    // Throws UsageError naming the option and what it takes.
    [[nodiscard]] LightingSettings lighting() const;

  private:
    CLI::App* parser_; // asked which options were given
    std::string environment_;
    float rotation_ = 0.0f;
    float intensity_ = 1.0f;
};

// The scene, built in or a file, with the environment map that the lighting names, if it names one. What had
// to be changed in the map becomes a warning of the scene. Throws Error for a file that is no scene, or no
// map.
[[nodiscard]] Scene loadLit(const std::string& nameOrPath, ImportOptions options,
                            const LightingSettings& lighting);

} // namespace lavalight
