// A progress bar on stderr, where a person is watching.
#pragma once

#include <chrono>

namespace lavalight {

// A bar that draws nothing unless stderr is a terminal, and redraws at most ten times a second.
class ProgressBar {
  public:
    explicit ProgressBar(bool wanted);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(double fraction); // in [0, 1]

  private:
    bool isDrawn_ = false;
    bool isOn_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point last_;
};

} // namespace lavalight
