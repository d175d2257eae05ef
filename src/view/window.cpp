#include "view/window.h"

#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {
namespace {

// The newest failure of GLFW, in its words.
std::string reason() {
    const char* text = nullptr;
    return glfwGetError(&text) == GLFW_NO_ERROR || text == nullptr ? "GLFW does not say why" : text;
}

// Starts GLFW, which runs as long as there is a window.
void start() {
    if (glfwInit() != GLFW_TRUE)
        throw Error(fmt::format("cannot open a window: {}; is there a desktop here (DISPLAY or "
                                "WAYLAND_DISPLAY)? lavalight render needs none",
                                reason()));
    if (glfwVulkanSupported() == GLFW_TRUE)
        return;
    glfwTerminate();
    throw Error("cannot open a window: no Vulkan driver here draws on windows; lavalight render needs none");
}

} // namespace

Window::Events& Window::eventsOf(GLFWwindow* window) {
    return *static_cast<Events*>(glfwGetWindowUserPointer(window));
}

void Window::keepDrops(GLFWwindow* window, int count, const char** paths) {
    auto& drops = eventsOf(window).drops;
    drops.insert(drops.end(), paths, paths + count);
}

void Window::keepKey(GLFWwindow* window, int key, int, int action, int modifiers) {
    eventsOf(window).hasInput = true;
    if (action == GLFW_PRESS)
        eventsOf(window).keys.push_back({key, modifiers});
}

void Window::keepButton(GLFWwindow* window, int, int, int) {
    eventsOf(window).hasInput = true;
}

void Window::keepMove(GLFWwindow* window, double, double) {
    eventsOf(window).hasInput = true;
}

Window::Window(const std::string& title, const glm::uvec2& size) {
    start();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ =
        glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y), title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        const std::string why = reason();
        glfwTerminate();
        throw Error(fmt::format("cannot open a window: {}", why));
    }
    glfwSetWindowUserPointer(window_, &events_);
    glfwSetDropCallback(window_, keepDrops);
    glfwSetKeyCallback(window_, keepKey);
    glfwSetMouseButtonCallback(window_, keepButton);
    glfwSetCursorPosCallback(window_, keepMove);
    glfwSetScrollCallback(window_, keepMove);
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::wait(double seconds) {
    glfwWaitEventsTimeout(seconds);
}

void Window::wake() {
    glfwPostEmptyEvent();
}

bool Window::isClosing() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::setSize(const glm::uvec2& size) {
    glfwSetWindowSize(window_, static_cast<int>(size.x), static_cast<int>(size.y));
}

glm::uvec2 Window::pixels() const {
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {width, height};
}

glm::vec2 Window::pixelsPerPoint() const {
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window_, &width, &height);
    return width > 0 && height > 0 ? glm::vec2(pixels()) / glm::vec2(width, height) : glm::vec2(1.0f);
}

float Window::textScale() const {
    float x = 1.0f;
    float y = 1.0f;
    glfwGetWindowContentScale(window_, &x, &y);
    return y;
}

bool Window::takeInput() {
    return std::exchange(events_.hasInput, false);
}

std::vector<std::string> Window::takeDrops() {
    return std::exchange(events_.drops, {});
}

std::vector<Window::KeyPress> Window::takeKeys() {
    return std::exchange(events_.keys, {});
}

} // namespace lavalight
