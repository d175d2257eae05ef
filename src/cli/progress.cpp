#include "cli/progress.h"

#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

namespace lavalight {

ProgressBar::ProgressBar(bool wanted)
    : isOn_(wanted && ::isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()), last_(start_) {
}

ProgressBar::~ProgressBar() {
    if (isDrawn_)
        fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::show(double fraction) {
    const auto now = std::chrono::steady_clock::now();
    if (!isOn_ || now - last_ < std::chrono::milliseconds(100))
        return;
    last_ = now;
    isDrawn_ = true;
    constexpr int width = 40;
    const auto filled = static_cast<size_t>(fraction * width);
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    fmt::print(stderr, "\r[{:<{}}] {:3.0f} %  {:.0f} s left \x1b[K", std::string(filled, '#'), width,
               100.0 * fraction, fraction > 0.0 ? elapsed * (1.0 - fraction) / fraction : 0.0);
    std::fflush(stderr);
}

} // namespace lavalight
