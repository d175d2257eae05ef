// The option that renders a part of an image.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "film/film_windows.h"

namespace lavalight {

// Declares --crop on a parser. Must outlive the parsing; the parser points into it.
class CropOptions {
  public:
    explicit CropOptions(CLI::App& parser);
    CropOptions(const CropOptions&) = delete;
    CropOptions& operator=(const CropOptions&) = delete;

    // The part; none: all of the image. Throws UsageError naming what the option takes.
    [[nodiscard]] std::optional<PixelWindow> window() const;

  private:
    std::string crop_;
};

} // namespace lavalight
