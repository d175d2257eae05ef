// A window of the desktop and what happens to it, by GLFW. From the main thread only, but for wake().
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

struct GLFWwindow;

namespace lavalight {

class Window {
  public:
    // Opens a window with an inner area of that many screen coordinates. Throws Error where there is no
    // desktop to open it on, or no Vulkan for its windows. There may be one window at a time.
    Window(const std::string& title, const glm::uvec2& size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Waits for input, wake(), or the time to be over.
    void wait(double seconds);
    // Ends a wait(), from any thread.
    static void wake();

    [[nodiscard]] bool isClosing() const;
    void close();
    void setTitle(const std::string& title);
    void setSize(const glm::uvec2& size);
    // Pixels to draw; 0 while minimised.
    [[nodiscard]] glm::uvec2 pixels() const;
    // Pixels per screen coordinate, in which mice are measured.
    [[nodiscard]] glm::vec2 pixelsPerPoint() const;
    // How large the desktop wants its text.
    [[nodiscard]] float textScale() const;
    // Whether a key or the mouse did anything since the last call.
    [[nodiscard]] bool takeInput();
    // Paths of files that were dropped here since the last call.
    [[nodiscard]] std::vector<std::string> takeDrops();
    // Keys pressed since the last call, in order: GLFW_KEY_... and the GLFW_MOD_... held with it.
    struct KeyPress {
        int key = 0;
        int modifiers = 0;
    };
    [[nodiscard]] std::vector<KeyPress> takeKeys();

    [[nodiscard]] GLFWwindow* handle() const { return window_; }

  private:
    struct Events {
        std::vector<std::string> drops;
        std::vector<KeyPress> keys;
        bool hasInput = false;
    };
    [[nodiscard]] static Events& eventsOf(GLFWwindow* window);
    static void keepDrops(GLFWwindow* window, int count, const char** paths);
    static void keepKey(GLFWwindow* window, int key, int scancode, int action, int modifiers);
    static void keepButton(GLFWwindow* window, int button, int action, int modifiers);
    static void keepMove(GLFWwindow* window, double x, double y); // motion of the mouse, or of its wheel

    GLFWwindow* window_ = nullptr;
    Events events_;
};

} // namespace lavalight
