// A desktop in memory for tests of the window: X server, window manager, mouse, keyboard, screenshots.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <sys/types.h>

#include "support/environment_variable.h"

namespace lavalight::test {

// A picture of opaque pixels, rows from the top.
struct Screenshot {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<glm::u8vec3> pixels;
    bool operator==(const Screenshot&) const = default;
};

// The desktop: programs that are started while it lives open their windows there.
class Desktop {
  public:
    // Throws std::runtime_error where Xvfb or openbox cannot be started.
    Desktop();
    ~Desktop();
    Desktop(const Desktop&) = delete;
    Desktop& operator=(const Desktop&) = delete;

    // Number of the window whose title begins so. Throws std::runtime_error where there is none within half a
    // minute.
    [[nodiscard]] std::string findWindow(const std::string& title) const;
    [[nodiscard]] std::string titleOf(const std::string& window) const;
    // A picture of what is inside the window's frame.
    [[nodiscard]] Screenshot shoot(const std::string& window) const;
    // Acts by words of xdotool: "key --clearmodifiers Tab", "mousemove 10 20 click 1".
    void input(const std::string& words) const;
    // Drops a file on a window, as a file manager does.
    void drop(const std::string& path, const std::string& window) const;

  private:
    pid_t server_ = 0;
    std::unique_ptr<EnvironmentVariable> display_;
    pid_t manager_ = 0;
};

// A PNG of 8 bits a channel, for comparison.
[[nodiscard]] Screenshot readPng(const std::filesystem::path& file);

} // namespace lavalight::test
