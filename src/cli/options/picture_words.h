// A picture's options as words, for callers without a command line: parsed, checked and refused as a shell's
// are.
#pragma once

#include <string>
#include <vector>

#include "gltf/import_options.h"
#include "session/render_session.h"

namespace lavalight {

// An option of a picture.
struct PictureOption {
    std::string name;  // without dashes
    bool isFlag;       // takes no value
    std::string value; // what it takes: "N", "WxH", "power|balance|off", ...
    std::string help;
};

// All options of a picture, in the order of `lavalight render --help`.
[[nodiscard]] std::vector<PictureOption> pictureOptions();

struct ParsedPicture {
    RenderPlan plan;
    ImportOptions moment;
};

// `words`: options and values, as a shell would pass them. Throws UsageError naming the option and what it
// takes, and Error where the denoiser is asked for and not there.
[[nodiscard]] ParsedPicture parsePicture(const std::string& scene, std::vector<std::string> words);

} // namespace lavalight
