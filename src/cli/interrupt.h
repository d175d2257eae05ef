// Ctrl-C as a question that the render asks between waves.
#pragma once

namespace lavalight {

// While an object lives, the first SIGINT or SIGTERM is only remembered; a second one ends the process at
// once. There may be one object at a time.
class InterruptGuard {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    [[nodiscard]] bool interrupted() const;
    // The exit code as shells have it: 130 for SIGINT, 143 for SIGTERM.
    [[nodiscard]] int exitCode() const;
};

} // namespace lavalight
