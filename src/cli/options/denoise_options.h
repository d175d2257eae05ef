// The option that denoises pictures.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "denoise/denoiser.h"

namespace lavalight {

// Declares --denoise on a parser. Must outlive the parsing; the parser points into it.
class DenoiseOptions {
  public:
    explicit DenoiseOptions(CLI::App& parser);
    DenoiseOptions(const DenoiseOptions&) = delete;
    DenoiseOptions& operator=(const DenoiseOptions&) = delete;

    // None: the option was not given.
    [[nodiscard]] std::optional<DenoiseQuality> quality() const;

  private:
    CLI::App* parser_; // asked whether the option was given
    std::string quality_;
};

} // namespace lavalight
