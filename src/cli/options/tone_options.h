// The options of what a display shows of an image.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "render/tone_settings.h"

namespace lavalight {

// Declares --tonemap and --exposure on a parser. Must outlive the parsing; the parser points into it.
class ToneOptions {
  public:
    explicit ToneOptions(CLI::App& parser);
    ToneOptions(const ToneOptions&) = delete;
    ToneOptions& operator=(const ToneOptions&) = delete;

    // Throws UsageError for an exposure that is none. An automatic one is 0 stops here.
    [[nodiscard]] ToneSettings settings() const;
    [[nodiscard]] bool isAutomatic() const { return exposure_ == kAutomatic; }
    [[nodiscard]] bool isGiven() const;

  private:
    CLI::App* parser_; // asked which options were given
    static constexpr const char* kAutomatic = "auto";
    ToneSettings tone_;
    std::string exposure_ = "0";
};

} // namespace lavalight
