// The option that says what is seen behind the scene.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>

#include "render/settings.h"

namespace lavalight {

// Declares --background on a parser. Must outlive the parsing; the parser points into it.
class BackgroundOptions {
  public:
    explicit BackgroundOptions(CLI::App& parser);
    BackgroundOptions(const BackgroundOptions&) = delete;
    BackgroundOptions& operator=(const BackgroundOptions&) = delete;

    // Throws UsageError naming what the option takes.
    [[nodiscard]] BackgroundSettings settings() const;
    // The colour that a PNG has behind what is covered, as linear display values; none: what settings() says.
    [[nodiscard]] std::optional<glm::vec3> backdrop() const;
    // The PNG's background as sRGB signals in [0, 1].
    [[nodiscard]] std::optional<glm::vec3> color() const;

  private:
    std::string background_ = "environment";
};

} // namespace lavalight
