// `lavalight render`: a scene in, an image out.
#pragma once

#include <functional>
#include <string>

#include "cli/command.h"
#include "cli/options/checkpoint_options.h"
#include "cli/options/render_options.h"
#include "cli/options/scene_options.h"
#include "cli/options/shader_options.h"
#include "cli/options/tone_options.h"
#include "session/frame_sequence.h"
#include "session/report.h"
#include "session/take.h"

namespace lavalight {

class RenderCommand : public Command {
  public:
    explicit RenderCommand(CLI::App& app);
    // Renders and writes the files asked for; 130 if interrupted, with the image so far written.
    [[nodiscard]] int run() override;

  private:
    // Files to write; empty: none.
    struct Outputs {
        std::string exr;
        std::string png;
        std::string report;
        std::string checkpoint;
    };
    struct Session; // what the frames of a sequence share

    void requireOutputs(const Outputs& files) const;
    [[nodiscard]] int runSequence(Session& session) const;
    [[nodiscard]] int runWatching(Session& session) const;
    [[nodiscard]] Take prepare(const ImportOptions& moment, Session& session) const;
    void takeSamples(Take& take, const std::function<bool()>& mayGoOn) const;
    void write(Take& take, const Outputs& files, Session& session) const;
    [[nodiscard]] int renderMoment(const Outputs& files, const ImportOptions& moment, Session& session) const;

    RenderOptions options_;
    SceneOptions sceneOptions_;
    FrameSequence sequence_;
    ShaderOptions shaders_;
    ToneOptions tone_;
    CheckpointOptions checkpoints_;
    std::string scene_ = "cornell-box";
    Outputs outputs_;
    bool quiet_ = false;
};

} // namespace lavalight
