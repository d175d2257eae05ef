// `lavalight render`: a scene in, an image out.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/options/checkpoint_options.h"
#include "cli/options/frame_options.h"
#include "cli/options/picture_options.h"
#include "cli/options/shader_options.h"
#include "session/render_session.h"

namespace lavalight {

class RenderCommand : public Command {
  public:
    explicit RenderCommand(CLI::App& app);
    // Renders and writes the files asked for; 130 if interrupted, with the image so far written.
    [[nodiscard]] int run() override;

  private:
    [[nodiscard]] RenderPlan plan() const;
    // Sorts the pictures that are asked for by their formats.
    void takeOutputs();
    void checkOptions() const;
    // The files of one frame.
    [[nodiscard]] Outputs outputsOf(uint32_t frame) const;
    // Throws UsageError where an output would replace an input or another output, of any frame.
    void requireOutputsApart(const RenderPlan& plan) const;
    [[nodiscard]] int runSequence(RenderSession& session) const;
    [[nodiscard]] int runWatching(RenderSession& session) const;
    // An image and, in a sequence, what follows it.
    struct Moment {
        ImportOptions now;
        std::optional<RenderSession::NextMoment> next;
    };
    [[nodiscard]] ImportOptions momentOf(uint32_t frame) const;
    // A frame and what follows it, once the session has turned to it.
    [[nodiscard]] Moment turnTo(uint32_t frame, RenderSession& session) const;
    [[nodiscard]] int renderMoment(RenderSession& session, const Moment& moment, const Outputs& outputs,
                                   Checkpoint& checkpoint) const;
    void finishImage(RenderSession& session, RenderJob& job, const Outputs& outputs) const;

    PictureOptions options_;
    FrameOptions frames_;
    ShaderOptions shaders_;
    CheckpointOptions checkpoints_;
    std::string scene_ = "cornell-box";
    std::vector<std::string> pictures_; // -o
    std::string png_;
    Outputs outputs_;
    bool quiet_ = false;
};

} // namespace lavalight
