// The options of what to show of a scene, shared by the commands that load one.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "gltf/import_options.h"

namespace lavalight {

// Declares --allow-external alone. `options` must outlive the parsing; the parser points into it.
void addAllowExternal(CLI::App& parser, ImportOptions& options);

// Must outlive the parsing; the parser points into it.
class SceneOptions {
  public:
    explicit SceneOptions(CLI::App& parser);
    SceneOptions(const SceneOptions&) = delete;
    SceneOptions& operator=(const SceneOptions&) = delete;

    // Throws UsageError naming the option and what it takes.
    [[nodiscard]] ImportOptions importOptions() const;
    // The options with a time that is not the user's. Throws UsageError if the user gave one too.
    [[nodiscard]] ImportOptions importOptionsAt(double seconds) const;

  private:
    CLI::App* parser_; // asked which options were given
    double seconds_ = 0.0;
    ImportOptions options_;
};

} // namespace lavalight
