// The option that denoises pictures.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "denoise/denoiser.h"

namespace lavalight {

// What --denoise is for where it stands, and what it means without a word.
struct DenoiseUse {
    std::string help;
    DenoiseQuality quality;
};

// Declares --denoise on a parser. Must outlive the parsing; the parser points into it.
class DenoiseOptions {
  public:
    DenoiseOptions(CLI::App& parser, const DenoiseUse& use);
    DenoiseOptions(const DenoiseOptions&) = delete;
    DenoiseOptions& operator=(const DenoiseOptions&) = delete;

    // None: the option was not given.
    [[nodiscard]] std::optional<DenoiseQuality> quality() const;

  private:
    CLI::App* parser_; // asked whether the option was given
    DenoiseQuality default_;
    std::string quality_;
};

} // namespace lavalight
