// Fuzzes the command line: what is parsed, and what is made of the options of a render. One argument a line.
#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/error.h"
#include "cli/command_line.h"
#include "cli/options/option_values.h"
#include "cli/options/render_options.h"
#include "cli/options/scene_options.h"
#include "cli/options/tone_options.h"
#include "film/sample_ranges.h"
#include "render/renderer.h"
#include "session/frame_sequence.h"

namespace {

using namespace lavalight;

class Arguments {
  public:
    explicit Arguments(std::string_view text) {
        words_.emplace_back("lavalight");
        for (const std::string_view word : splitAt(text, '\n'))
            words_.emplace_back(word.substr(0, word.find('\0')));
        for (const std::string& word : words_)
            pointers_.push_back(word.c_str());
    }

    [[nodiscard]] int count() const { return static_cast<int>(pointers_.size()); }
    [[nodiscard]] const char* const* values() const { return pointers_.data(); }

  private:
    std::vector<std::string> words_;
    std::vector<const char*> pointers_;
};

Scene sceneOfOneCamera() {
    Scene scene;
    scene.source = "scene";
    scene.cameras.push_back({.name = "camera"});
    return scene;
}

void parseCommandLine(const Arguments& arguments) {
    CommandLine commandLine;
    std::ostringstream help;
    static_cast<void>(commandLine.parse(arguments.count(), arguments.values(), help));
}

void readOptions(const Arguments& arguments) {
    CLI::App parser;
    const RenderOptions options(parser);
    const SceneOptions sceneOptions(parser);
    const ToneOptions tone(parser);
    const FrameSequence frames(parser);
    try {
        parser.parse(arguments.count(), arguments.values());
    } catch (const CLI::Error&) {
        return;
    }
    RenderSettings settings = options.settings();
    const Camera camera = options.cameraOf(sceneOfOneCamera());
    settings = resolveSize(settings, camera);
    checkSettings(settings);
    static_cast<void>(sceneOptions.importOptions());
    static_cast<void>(tone.settings());
    if (frames.isAsked())
        static_cast<void>(frames.range());
}

template <class Act>
void attempt(const Act& act) {
    try {
        act();
    } catch (const Error&) {
        return;
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const Arguments arguments(text);
    attempt([&] { parseCommandLine(arguments); });
    attempt([&] { readOptions(arguments); });
    static_cast<void>(parseSampleRanges(text));
    return 0;
}
