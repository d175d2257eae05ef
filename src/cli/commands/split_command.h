// `lavalight split`: a render as a folder of parts, which many machines may render.
#pragma once

#include <filesystem>
#include <string>

#include "cli/command.h"
#include "cli/options/frame_options.h"
#include "cli/options/picture_options.h"
#include "cli/options/shader_options.h"
#include "split/split_plan.h"

namespace lavalight {

class SplitCommand : public Command {
  public:
    explicit SplitCommand(CLI::App& app);
    [[nodiscard]] int run() override;

  private:
    // Throws UsageError for options that cannot be split, or make no sense together.
    void checkOptions() const;
    [[nodiscard]] SplitPlan plan() const;
    // Copies what the parts read into the job's folder, and names it there.
    void bundle(const RenderPlan& render, bool allowsExternal, SplitPlan& plan,
                const std::filesystem::path& folder) const;

    PictureOptions options_;
    FrameOptions frames_;
    ShaderOptions shaders_;
    std::string scene_ = "cornell-box";
    uint32_t parts_ = 0;
    SplitEngine engine_ = SplitEngine::shell;
    std::string output_;
    bool hasPng_ = false;
    bool isStatistical_ = false;
    std::string constraint_;
    std::string program_ = "lavalight";
    double checkpointSeconds_ = 60.0;
};

} // namespace lavalight
