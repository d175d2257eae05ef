// The option that says what lies below the scene.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "render/settings.h"

namespace lavalight {

// Declares --ground on a parser. Must outlive the parsing; the parser points into it.
class GroundOptions {
  public:
    explicit GroundOptions(CLI::App& parser);
    GroundOptions(const GroundOptions&) = delete;
    GroundOptions& operator=(const GroundOptions&) = delete;

    // Throws UsageError naming what the option takes.
    [[nodiscard]] GroundSettings settings() const;

  private:
    std::string ground_ = "none";
};

} // namespace lavalight
