#include "view/shader_watcher.h"

#include <chrono>
#include <utility>

#include "base/error.h"

namespace lavalight {
namespace {

// How long the end of the program may wait for this thread.
constexpr std::chrono::milliseconds kLookEvery(100);

} // namespace

ShaderWatcher::ShaderWatcher(std::string folder, std::shared_ptr<ShaderOverlay> first, KernelNames names,
                             std::function<void()> wake)
    : folder_(std::move(folder)), wake_(std::move(wake)), saves_(folder_), overlay_(std::move(first)),
      names_(std::move(names)), thread_([this] { run(); }) {}

ShaderWatcher::~ShaderWatcher() {
    isEnding_ = true;
    thread_.join();
}

void ShaderWatcher::use(KernelNames names) {
    const std::lock_guard lock(mutex_);
    names_ = std::move(names);
}

std::optional<ShaderWatcher::Change> ShaderWatcher::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(change_, std::nullopt);
}

void ShaderWatcher::run() {
    while (!isEnding_) {
        const std::vector<std::string> files = saves_.wait(kLookEvery);
        if (!files.empty())
            look(files);
    }
}

ShaderWatcher::Contents ShaderWatcher::contentsOf(ShaderOverlay& overlay, const KernelNames& names) {
    Contents contents;
    for (const std::string_view name : names)
        contents[std::string(name)] = overlay.kernel(name).content;
    for (const char* name : {"albedo", "tonemap"})
        contents[name] = overlay.kernel(name).content;
    return contents;
}

void ShaderWatcher::look(const std::vector<std::string>& files) {
    Change change{files, {}, nullptr, {}};
    const KernelNames names = [&] {
        const std::lock_guard lock(mutex_);
        return names_;
    }();
    try {
        auto now = std::make_shared<ShaderOverlay>(folder_);
        const Contents before = contentsOf(*overlay_, names);
        for (const auto& [name, content] : contentsOf(*now, names))
            if (before.at(name) != content)
                change.kernels.push_back(name);
        if (!change.kernels.empty())
            overlay_ = change.overlay = std::move(now);
    } catch (const Error& error) {
        change.error = error.what();
    }
    keep(std::move(change));
    wake_();
}

// One that nobody took yet becomes part of the newer one.
void ShaderWatcher::keep(Change change) {
    const std::lock_guard lock(mutex_);
    if (change_) {
        change.files.insert(change.files.end(), change_->files.begin(), change_->files.end());
        change.kernels.insert(change.kernels.end(), change_->kernels.begin(), change_->kernels.end());
        if (change.overlay == nullptr)
            change.overlay = change_->overlay;
    }
    change_ = std::move(change);
}

} // namespace lavalight
