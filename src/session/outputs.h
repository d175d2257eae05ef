// The files that a render writes.
#pragma once

#include <string>

#include "render/tone_mapper.h"
#include "session/render_job.h"

namespace lavalight {

// Paths; empty: none.
struct Outputs {
    std::string exr;
    std::string png;
    std::string report;     // JSON
    std::string checkpoint; // kept by a Checkpoint, not by writeOutputs
};

// Throws UsageError where one file is to hold two outputs, and Error where one cannot be written.
void requireOutputs(const Outputs& outputs);

// How images are written.
struct OutputStyle {
    bool keepsFilm = false; // the EXR file holds the exact film beside the picture
    ToneSettings tone;      // of the PNG
};

// Writes the image so far, and completes the job's report. `toneMapper` may be null where there is no PNG.
// Throws Error.
void writeOutputs(RenderJob& job, const Outputs& outputs, const OutputStyle& style, ToneMapper* toneMapper);

} // namespace lavalight
