// Milliseconds from a move of the mouse to its picture on the desktop: a measurement, no test. Prints the
// median and the range of a hundred moves. Arguments: those of lavalight view; with --denoise, moves come at
// different moments of denoising, too. It knows pictures of a moving camera by their coarseness, which they
// have where 30 ms are too short for a sample of all pixels.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include "support/desktop/desktop.h"
#include "support/running_program.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

constexpr int kMoves = 100;
constexpr std::chrono::seconds kPatience(5);

// The middle of a window, over and over.
class Watcher {
  public:
    explicit Watcher(unsigned long window) : display_(::XOpenDisplay(nullptr)), window_(window) {
        XWindowAttributes size;
        ::XGetWindowAttributes(display_, window_, &size);
        x_ = size.width / 2 - kSide / 2;
        y_ = size.height / 2 - kSide / 2;
    }
    ~Watcher() { ::XCloseDisplay(display_); }
    Watcher(const Watcher&) = delete;
    Watcher& operator=(const Watcher&) = delete;

    [[nodiscard]] std::string look() const {
        XImage* const image = ::XGetImage(display_, window_, x_, y_, kSide, kSide, AllPlanes, ZPixmap);
        std::string pixels(image->data, static_cast<size_t>(image->bytes_per_line) * kSide);
        XDestroyImage(image);
        return pixels;
    }
    // Whether a third of the rows are those above them.
    [[nodiscard]] bool isCoarse() const {
        const std::string pixels = look();
        const size_t row = pixels.size() / kSide;
        size_t equal = 0;
        for (size_t y = 1; y < kSide; ++y)
            equal += pixels.compare(y * row, row, pixels, (y - 1) * row, row) == 0 ? 1 : 0;
        return 3 * equal >= kSide;
    }
    void moveMouse(int right) const {
        ::XWarpPointer(display_, None, None, 0, 0, 0, 0, right, 0);
        ::XSync(display_, False);
    }

  private:
    static constexpr unsigned kSide = 128;
    Display* display_;
    unsigned long window_;
    int x_ = 0;
    int y_ = 0;
};

// Time until the picture is that of a moving camera; the patience where it never is.
double milliseconds(const Watcher& watcher, int right) {
    const auto start = std::chrono::steady_clock::now();
    watcher.moveMouse(right);
    while (!watcher.isCoarse() && std::chrono::steady_clock::now() - start < kPatience)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

int measure(std::vector<std::string> words) {
    const Desktop desktop;
    const TemporaryFolder folder;
    words.insert(words.begin(), "view");
    RunningProgram program(words, folder.path());
    const std::string window = desktop.findWindow("Lavalight");
    while (desktop.titleOf(window).find(" 2 samples") == std::string::npos)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    desktop.input("windowfocus --sync " + window + " key Tab mousemove --window " + window +
                  " 320 240 mousedown 1");
    const Watcher watcher(std::stoul(window));
    std::vector<double> times;
    for (int i = 0; i < kMoves; ++i) {
        // At different moments of what the program does meanwhile: the camera is still after 200 ms.
        std::this_thread::sleep_for(std::chrono::milliseconds(250 + 7 * i));
        while (watcher.isCoarse())
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        times.push_back(milliseconds(watcher, i % 2 == 0 ? 8 : -8));
    }
    std::sort(times.begin(), times.end());
    std::printf("%d moves: median %.0f ms, %.0f to %.0f ms, nine of ten below %.0f ms\n", kMoves,
                times[kMoves / 2], times.front(), times.back(), times[kMoves * 9 / 10]);
    desktop.input("mouseup 1");
    return EXIT_SUCCESS;
}

} // namespace
} // namespace lavalight::test

int main(int argc, char** argv) {
    return lavalight::test::measure({argv + 1, argv + argc});
}
