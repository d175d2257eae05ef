// Compiles shaders in the background whenever they are saved.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/os/file_watch.h"
#include "kernels/shader_overlay.h"

namespace lavalight {

class ShaderWatcher {
  public:
    using KernelNames = std::vector<std::string>; // by decisiveKernels()

    // `first`: the folder as it is now. `wake` is called, from another thread, when there is a change. Throws
    // Error where there is no such folder.
    ShaderWatcher(std::string folder, std::shared_ptr<ShaderOverlay> first, KernelNames names,
                  std::function<void()> wake);
    ~ShaderWatcher();
    ShaderWatcher(const ShaderWatcher&) = delete;
    ShaderWatcher& operator=(const ShaderWatcher&) = delete;

    // Names of the estimator's kernels that matter from now on.
    void use(KernelNames names);

    struct Change {
        std::vector<std::string> files;
        std::vector<std::string> kernels;       // kernels whose code is another
        std::shared_ptr<ShaderOverlay> overlay; // null: nothing is to be done
        std::string error;                      // message of the newest save; empty: it compiles
    };
    [[nodiscard]] std::optional<Change> take();

  private:
    using Contents = std::map<std::string, std::string>; // by kernel

    void run();
    void look(const std::vector<std::string>& files);
    [[nodiscard]] static Contents contentsOf(ShaderOverlay& overlay, const KernelNames& names);
    void keep(Change change);

    std::string folder_;
    std::function<void()> wake_;
    FileWatch saves_;
    std::shared_ptr<ShaderOverlay> overlay_; // the newest that compiles
    std::atomic<bool> isEnding_ = false;
    std::mutex mutex_; // guards names_ and change_
    KernelNames names_;
    std::optional<Change> change_;
    std::thread thread_; // last: started when all else is there
};

} // namespace lavalight
