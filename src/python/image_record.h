// What an image in Python is made of, and its way to another process.
#pragma once

#include <string>
#include <string_view>

#include "image/exr.h"
#include "session/outputs.h"

namespace lavalight::python {

struct ImageRecord {
    FinishedImage image;
    Metadata header;    // of an EXR file that does not hold the film
    std::string report; // JSON
    bool isComplete = true;
};

[[nodiscard]] std::string imageBytes(const ImageRecord& record);
// Throws Error for bytes that imageBytes() did not make.
[[nodiscard]] ImageRecord imageFromBytes(std::string_view bytes);

} // namespace lavalight::python
