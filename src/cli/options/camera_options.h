// The options that say where the camera is and how it projects.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "session/camera_choice.h"

namespace lavalight {

// Declares options on a parser and turns their values into a choice. Must outlive the parsing; the parser
// points into it.
class CameraOptions {
  public:
    explicit CameraOptions(CLI::App& parser);
    CameraOptions(const CameraOptions&) = delete;
    CameraOptions& operator=(const CameraOptions&) = delete;

    // Throws UsageError naming the option and what it takes.
    [[nodiscard]] CameraChoice choice() const;

  private:
    CLI::App* parser_; // asked which options were given
    std::string from_;
    std::string at_;
    std::string up_;
    std::string intrinsics_;
    std::string clip_;
    CameraChoice choice_; // the values that need no parsing
};

} // namespace lavalight
