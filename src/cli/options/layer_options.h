// The option that asks for layers beside the colour.
#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

namespace lavalight {

// Declares --aov on a parser. Must outlive the parsing; the parser points into it.
class LayerOptions {
  public:
    explicit LayerOptions(CLI::App& parser);
    LayerOptions(const LayerOptions&) = delete;
    LayerOptions& operator=(const LayerOptions&) = delete;

    // Planes of the film (RenderSettings::layers). Throws UsageError naming a layer that there is not.
    [[nodiscard]] uint32_t layers() const;

  private:
    std::string names_;
};

} // namespace lavalight
