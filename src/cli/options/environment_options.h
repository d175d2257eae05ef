// The options that say what shines where nothing is hit.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "render/settings.h"

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
    SkySettings sky_;
    float rotation_ = 0.0f;
    float intensity_ = 1.0f;
};

} // namespace lavalight
