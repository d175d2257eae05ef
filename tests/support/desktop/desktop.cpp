#include "support/desktop/desktop.h"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include "base/file.h"
#include "image/picture.h"
#include "support/desktop/drag_source.h"
#include "support/spawn.h"

namespace lavalight::test {
namespace {

constexpr std::chrono::milliseconds kTurn(20);
constexpr std::chrono::seconds kPatience(30);

// Starts a program whose output nobody reads; `passed`: a descriptor that it gets as number 3.
pid_t startSilently(const std::vector<std::string>& words, int passed = -1) {
    Spawn spawn;
    spawn.open(STDOUT_FILENO, "/dev/null", O_WRONLY);
    spawn.open(STDERR_FILENO, "/dev/null", O_WRONLY);
    if (passed >= 0)
        spawn.pass(3, passed);
    return spawn.start(words);
}

// The server takes a free number and tells it. Without -noreset it would start again whenever its last client
// leaves, and isManaged(), coming and going, would end a window manager that is still starting.
pid_t startServer(std::string& display) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::runtime_error("no pipe for Xvfb");
    const pid_t server = startSilently(
        {"Xvfb", "-displayfd", "3", "-screen", "0", "1280x800x24", "-nolisten", "tcp", "-noreset"}, ends[1]);
    ::close(ends[1]);
    std::string number;
    char digit = 0;
    while (::read(ends[0], &digit, 1) == 1 &&
           digit != '\n') // a pipe closed before its line end ends the server
        number += digit;
    ::close(ends[0]);
    if (number.empty())
        throw std::runtime_error("Xvfb did not start");
    display = std::string(":").append(number);
    return server;
}

void stop(pid_t process) {
    ::kill(process, SIGTERM);
    ::waitpid(process, nullptr, 0);
}

// Whether a window manager has said, as all do, which window it checks in with.
bool isManaged() {
    Display* const display = ::XOpenDisplay(nullptr);
    if (display == nullptr)
        return false;
    const Atom property = ::XInternAtom(display, "_NET_SUPPORTING_WM_CHECK", False);
    Atom type = None;
    int format = 0;
    unsigned long count = 0;
    unsigned long left = 0;
    unsigned char* value = nullptr;
    ::XGetWindowProperty(display, ::XDefaultRootWindow(display), property, 0, 1, False, AnyPropertyType,
                         &type, &format, &count, &left, &value);
    if (value != nullptr)
        ::XFree(value);
    ::XCloseDisplay(display);
    return count > 0;
}

std::string outputOf(const std::string& command) {
    FILE* const pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr)
        throw std::runtime_error("cannot run " + command);
    std::string out;
    std::array<char, 65536> part{};
    while (const size_t count = std::fread(part.data(), 1, part.size(), pipe))
        out.append(part.data(), count);
    ::pclose(pipe);
    return out;
}

} // namespace

Desktop::Desktop() {
    std::string display;
    server_ = startServer(display);
    display_ = std::make_unique<EnvironmentVariable>("DISPLAY", display);
    manager_ = startSilently({"openbox", "--sm-disable"});
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (!isManaged()) {
        if (std::chrono::steady_clock::now() > deadline) {
            stop(manager_);
            stop(server_);
            throw std::runtime_error("openbox did not start");
        }
        std::this_thread::sleep_for(kTurn);
    }
}

Desktop::~Desktop() {
    stop(manager_);
    stop(server_);
}

std::string Desktop::findWindow(const std::string& title) const {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < deadline) {
        const std::string found =
            outputOf("xdotool search --onlyvisible --name '^" + title + "' 2>/dev/null");
        if (!found.empty())
            return found.substr(0, found.find('\n'));
        std::this_thread::sleep_for(kTurn);
    }
    throw std::runtime_error("no window is called " + title);
}

std::string Desktop::titleOf(const std::string& window) const {
    return outputOf("xdotool getwindowname " + window + " 2>/dev/null");
}

Screenshot Desktop::shoot(const std::string& window) const {
    Display* const display = ::XOpenDisplay(nullptr);
    const Window handle = std::stoul(window);
    XWindowAttributes size;
    ::XGetWindowAttributes(display, handle, &size);
    Screenshot shot{static_cast<uint32_t>(size.width), static_cast<uint32_t>(size.height), {}};
    XImage* const image = ::XGetImage(display, handle, 0, 0, shot.width, shot.height, AllPlanes, ZPixmap);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const unsigned long pixel = XGetPixel(image, x, y); // pixel of a screen of 24 bits
            shot.pixels.emplace_back(pixel >> 16 & 255, pixel >> 8 & 255, pixel & 255);
        }
    XDestroyImage(image);
    ::XCloseDisplay(display);
    return shot;
}

void Desktop::input(const std::string& words) const {
    if (std::system(("xdotool " + words).c_str()) != 0)
        throw std::runtime_error("xdotool cannot do this: " + words);
}

void Desktop::drop(const std::string& path, const std::string& window) const {
    dragAndDrop(path, std::stoul(window));
}

Screenshot readPng(const std::filesystem::path& file) {
    const Picture picture = decodePicture(readFile(file));
    Screenshot shot{picture.width, picture.height, {}};
    for (size_t at = 0; at < picture.bytes.size(); at += 4)
        shot.pixels.emplace_back(picture.bytes[at], picture.bytes[at + 1], picture.bytes[at + 2]);
    return shot;
}

} // namespace lavalight::test
