// Shaders that the user changed, and watching them change.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/input_files.h"
#include "kernels/shader_overlay.h"
#include "render/renderer.h"
#include "render/tone_mapper.h"
#include "session/render_session.h"

namespace lavalight {

// Declares --shaders. Must outlive the parsing; the parser points into it.
class ShaderOptions {
  public:
    explicit ShaderOptions(CLI::App& parser);
    ShaderOptions(const ShaderOptions&) = delete;
    ShaderOptions& operator=(const ShaderOptions&) = delete;

    // Declares --watch too.
    void declareWatch(CLI::App& parser);

    // Watches as if --watch were given, where there is a folder to watch.
    void watchIfThere();
    [[nodiscard]] bool isWatching() const { return isWatching_; }
    // The folder of --shaders or, to watch, the source tree's own where that is the working folder. Throws
    // UsageError where there is neither.
    [[nodiscard]] std::string folder() const;
    // An overlay of the folder as it is now; null where none was asked for. Warns of files that nothing
    // includes. Throws as ShaderOverlay does.
    [[nodiscard]] std::shared_ptr<ShaderOverlay> overlay() const;

    // Adds the files of the folder to those that no output may replace.
    void addFiles(InputFiles& inputs) const;

    // An overlay of the folder once the files `changes` are saved; null unless they give the job other
    // kernels. Tells on stderr what changed, and what does not compile.
    [[nodiscard]] std::shared_ptr<ShaderOverlay>
    reread(const std::vector<std::string>& changes, const RenderSession& session, const RenderJob& job) const;

  private:
    std::string folder_;
    bool isWatching_ = false;
};

} // namespace lavalight
