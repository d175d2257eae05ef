// The options of renders that survive being ended.
#pragma once

#include <chrono>
#include <string>

#include <CLI/CLI.hpp>

#include "render/settings.h"

namespace lavalight {

// Must outlive the parsing; the parser points into it.
class CheckpointOptions {
  public:
    explicit CheckpointOptions(CLI::App& parser);
    CheckpointOptions(const CheckpointOptions&) = delete;
    CheckpointOptions& operator=(const CheckpointOptions&) = delete;

    // The file as given, unchecked; empty: none.
    [[nodiscard]] const std::string& given() const { return file_; }
    // The file; empty: no checkpoints are wanted. Throws UsageError for options that make no sense together,
    // and Error where the file must not be written.
    [[nodiscard]] std::string file(const RenderSettings& settings) const;
    [[nodiscard]] std::chrono::duration<double> interval() const {
        return std::chrono::duration<double>(seconds_);
    }
    [[nodiscard]] bool isResuming() const { return isResuming_; }

  private:
    CLI::App* parser_; // asked which options were given
    std::string file_;
    double seconds_ = 60.0;
    bool isResuming_ = false;
};

} // namespace lavalight
